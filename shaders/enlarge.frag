// The picture from one of half its size: each pixel the mean of the four nearest, the nearer the more.

layout(binding = kUnitImage) uniform sampler2D small; // interpolates

layout(location = 0) out vec4 colour;

void main() { colour = texture(small, 0.5 * gl_FragCoord.xy / vec2(textureSize(small, 0))); }
