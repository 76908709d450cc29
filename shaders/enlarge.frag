// Enlarges a picture of half the size by bilinear interpolation.

layout(binding = kUnitImage) uniform sampler2D small; // interpolates

layout(location = 0) out vec4 colour;

void main() { colour = texture(small, 0.5 * gl_FragCoord.xy / vec2(textureSize(small, 0))); }
