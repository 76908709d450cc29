// The picture from one of half its size: each pixel the mean of the four nearest, the nearer the more.
#version 450 core

layout(binding = 0) uniform sampler2D small;

layout(location = 0) out vec4 colour;

void main() {
    // The next pixels' centres lie a quarter of a texel beside this one's, whichever side it is on.
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 texel = pixel >> 1;
    ivec2 last = textureSize(small, 0) - 1;
    ivec2 beside = clamp(texel + ((pixel & 1) * 2 - 1), ivec2(0), last);
    colour = 0.5625 * texelFetch(small, texel, 0) +
             0.1875 * (texelFetch(small, ivec2(beside.x, texel.y), 0) + texelFetch(small, ivec2(texel.x, beside.y), 0)) +
             0.0625 * texelFetch(small, beside, 0);
}
