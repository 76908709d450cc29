// The view, for all full-screen passes. Eye space looks along -z; depth is positive, in mm.
layout(std140, binding = kBlockView) uniform View {
#include "view_block.glsl"
};

const float kNothing = 1e30;

float eye_depth(float value) {
    return picture.w > 0.5 ? (value - clip_to_eye.z) * clip_to_eye.y : clip_to_eye.z / (value + clip_to_eye.y);
}

#include "look/position.glsl"

vec3 unpack_normal(uint bits) { return from_octahedral(unpackSnorm2x16(bits)); }
