// Adds one view of a refined picture in linear light; the target sums by blending.
#include "pictures.glsl"

layout(location = 0) out vec4 light;

void main() { light = to_light(texelFetch(image, ivec2(gl_FragCoord.xy), 0)); }
