layout(location = 0) in vec4 position_in;
uniform mat4 view_projection;
uniform vec3 box_low_mm, box_size_mm;

void main() { gl_Position = view_projection * vec4(box_low_mm + position_in.xyz * box_size_mm, 1.0); }
