// Slices of a scan, for shaders; see look/slices.glsl.
layout(std140, binding = kBlockPlanes) uniform Planes {
#include "planes_block.glsl"
};
layout(binding = kUnitPlanes) uniform sampler2DArray plane_pictures; // all as large as the largest; each from a corner on
layout(location = kUniformSamplePositions) uniform vec2 positions_in_pixel[kMostSamples];

vec2 sample_offset(int s) { return positions_in_pixel[s]; }

vec4 plane_texel(int plane, vec2 at, vec2 size) {
    vec2 texel = clamp(at * size, vec2(0.5), size - 0.5);
    return textureLod(plane_pictures, vec3(texel / vec2(textureSize(plane_pictures, 0).xy), float(plane)), 0.0);
}
#include "look/slices.glsl"
