// Light lines with a dark edge read over vessels and over any background; fainter where vessels hide them.
#version 450 core
#include "bindings.glsl"
#include "view.glsl"

layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(location = kUniformToInner) uniform vec2 to_inner; // pixels of the picture to those of what was drawn

in vec3 at;
flat in vec3 ink;

layout(location = 0) out vec4 colour;

void main() {
    float depth = picture.w > 0.5 ? at.z : 1.0 / at.z;
    float before = texelFetch(opaque_depth, ivec2(gl_FragCoord.xy * to_inner), 0).x;
    float pixel_mm = pixel_to_eye.z * (picture.w > 0.5 ? 1.0 : depth);
    float seen = depth > before + 1.5 * pixel_mm ? 0.34 : 1.0;
    float light = clamp(at.y - abs(at.x) + 0.5, 0.0, 1.0);
    float dark = 0.55 * clamp(at.y - abs(at.x) + 1.5, 0.0, 1.0) * (1.0 - light);
    colour = seen * vec4(light * ink + dark * vec3(0.04), light + dark);
}
