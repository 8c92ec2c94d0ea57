layout(location = 0) in vec4 position_in;
layout(location = 6) in vec3 posed_mm_in;
uniform mat4 view_projection;
uniform vec3 box_low_mm, box_size_mm;
uniform bool moves;

void main() {
    gl_Position = view_projection * vec4(moves ? posed_mm_in : box_low_mm + position_in.xyz * box_size_mm, 1.0);
}
