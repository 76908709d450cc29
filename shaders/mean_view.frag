// The mean of several views; `image` is their sum. The views are dithered already.
#include "pictures.glsl"

layout(location = kUniformShare) uniform float share; // weight of each view

layout(location = 0) out vec4 colour;

void main() { colour = from_light(share * texelFetch(image, ivec2(gl_FragCoord.xy), 0)); }
