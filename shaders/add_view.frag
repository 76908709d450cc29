// One of the views that a fine picture is the mean of, in linear light: the target adds it to those before.
#include "pictures.glsl"

layout(location = 0) out vec4 light;

void main() { light = to_light(texelFetch(image, ivec2(gl_FragCoord.xy), 0)); }
