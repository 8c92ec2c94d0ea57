// A vertex as the exporter packs it in 36 bytes: whole numbers over ranges, halves for the curvature.
layout(location = 0) in vec4 position_in;   // over the mesh's box; occlusion in w
layout(location = 1) in vec4 normal_in;     // the bitangent's sign in w
layout(location = 2) in vec4 tangent_in;
layout(location = 3) in vec2 uv_in;         // over its range
layout(location = 4) in vec4 curvature_in;  // along the tangent, along the bitangent, mixed; in 1/mm
layout(location = 5) in vec4 occlusion_in;  // three blurs
layout(location = 6) in vec3 posed_mm_in;   // these of an object that moves
layout(location = 7) in vec3 posed_normal_in;
layout(location = 8) in vec3 posed_tangent_in;
layout(location = 9) in float curvature_change_per_mm_in;  // of the mean curvature, by morph targets

uniform mat4 view_projection;
uniform vec3 box_low_mm, box_size_mm;
uniform vec2 uv_low, uv_size;
uniform bool moves;

out vec3 p_mm;
out vec3 normal;
out vec4 tangent;
out vec2 uv;
out vec3 curvature_diagonal_per_mm, curvature_mixed_per_mm;  // the curvature tensor: skin.essl
out vec4 occlusion;                                          // sharp, and three blurs

void main() {
    p_mm = moves ? posed_mm_in : box_low_mm + position_in.xyz * box_size_mm;
    normal = normalize(moves ? posed_normal_in : normal_in.xyz);
    vec3 along = moves ? posed_tangent_in : tangent_in.xyz;
    vec3 t = normalize(along - normal * dot(normal, along)), b = cross(normal, t);  // the curvature turns with them
    tangent = vec4(t, normal_in.w < 0.0 ? -1.0 : 1.0);
    uv = uv_low + uv_in * uv_size;
    vec3 k = curvature_in.xyz;
    if (moves) k.xy += curvature_change_per_mm_in;
    curvature_diagonal_per_mm = k.x * t * t + k.y * b * b + 2.0 * k.z * t * b;
    curvature_mixed_per_mm = k.x * t.yxx * t.zzy + k.y * b.yxx * b.zzy + k.z * (t.yxx * b.zzy + b.yxx * t.zzy);
    occlusion = vec4(position_in.w, occlusion_in.xyz);
    gl_Position = view_projection * vec4(p_mm, 1.0);
}
