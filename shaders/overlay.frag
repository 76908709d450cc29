// Draws a small picture (straight alpha) over the picture, without scaling.

layout(binding = kUnitImage) uniform sampler2D sprite;
layout(location = kUniformOrigin) uniform ivec2 origin; // lower left corner in pixels

layout(location = 0) out vec4 colour;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) - origin;
    vec4 straight = texelFetch(sprite, ivec2(texel.x, textureSize(sprite, 0).y - 1 - texel.y), 0);
    colour = vec4(straight.rgb * straight.a, straight.a);
}
