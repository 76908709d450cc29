// The picture that is the mean of several views, whose sum `image` is. They have noise against banding already.
#include "pictures.glsl"

layout(location = kUniformShare) uniform float share; // that each view has

layout(location = 0) out vec4 colour;

void main() { colour = from_light(share * texelFetch(image, ivec2(gl_FragCoord.xy), 0)); }
