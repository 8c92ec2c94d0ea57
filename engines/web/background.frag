uniform vec3 background_linear;
uniform float exposure;
uniform int tone_map;
out vec4 color;

void main() { color = vec4(srgb_encode(tone_mapped(background_linear * exposure, tone_map)), 1.0); }
