// The skeleton over the picture: light lines with a dark edge; fainter inside their own vessel, faint behind another.
#version 450 core
#include "bindings.glsl"
#include "view.glsl"

layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(location = kUniformHalfPicture) uniform vec3 half_picture; // half the size in pixels, half the width of a line
layout(location = kUniformTint) uniform vec4 tint;         // sRGB; how much is left of it inside its vessel
layout(location = kUniformToInner) uniform vec2 to_inner;     // pixels of the picture to those of what was drawn

in vec2 at;
in vec2 behind;
in float ink;

layout(location = 0) out vec4 colour;

const float kBehind = 0.07; // how much is left of it behind another vessel

void main() {
    float before = texelFetch(opaque_depth, ivec2(gl_FragCoord.xy * to_inner), 0).x;
    float pixel_mm = pixel_to_eye.z * (picture.w > 0.5 ? 1.0 : at.y);
    float depth = at.y - before;
    float seen = ink * (depth <= max(1.5 * pixel_mm, behind.x) ? 1.0 : depth <= behind.y + pixel_mm ? tint.a : kBehind);
    float light = clamp(half_picture.z - abs(at.x) + 0.5, 0.0, 1.0);
    float dark = 0.5 * clamp(half_picture.z - abs(at.x) + 1.5, 0.0, 1.0) * (1.0 - light);
    colour = seen * vec4(light * tint.rgb + dark * vec3(0.04), light + dark);
}
