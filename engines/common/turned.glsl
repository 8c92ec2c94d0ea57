// A head that moves was baked in the frames that its vertices had then: tangent, normal x tangent, normal. Each vertex carries the
// quaternion of its frame. A direction keeps its coordinates in the frame of the pose, so that what was baked turns with the surface.
#ifndef DERMIS_TURNED_GLSL
#define DERMIS_TURNED_GLSL

// The direction in the space of the bakes that has these coordinates in the frame, a quaternion x y z w.
vec3 turned(vec4 frame, vec3 coordinates) {
    vec3 half_way = cross(frame.xyz, coordinates) + frame.w * coordinates;
    return coordinates + 2.0 * cross(frame.xyz, half_way);
}

#endif
