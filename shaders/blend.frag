// Mixes two pictures: a fade in linear light, or a wipe with a line. Where both are equal, at the ends of the fade, and
// beside the line, the output equals an input exactly.
#include "pictures.glsl"

layout(binding = kUnitOtherImage) uniform sampler2D second;
layout(location = kUniformShare) uniform float share; // of the second
layout(location = kUniformLine) uniform vec3 line;

layout(location = 0) out vec4 colour;

const vec4 kLineColour = vec4(0.93, 0.94, 0.96, 1.0); // sRGB

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 a = texelFetch(image, at, 0), b = texelFetch(second, at, 0);
    if (line.x >= 0.0)
        colour = abs(gl_FragCoord.x - line.x) < line.y && gl_FragCoord.y < line.z ? kLineColour
                 : gl_FragCoord.x < line.x                                       ? a
                                                                                  : b;
    else if (share <= 0.0 || a == b)
        colour = a;
    else if (share >= 1.0)
        colour = b;
    else
        colour = from_light(mix(to_light(a), to_light(b), share));
}
