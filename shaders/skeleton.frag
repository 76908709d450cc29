// The skeleton over the picture: fainter inside its own vessel, nearly invisible behind another.
#include "view.glsl"
#include "ink.glsl"

layout(location = kUniformHalfPicture) uniform vec3 half_picture; // half the size in pixels, half the width of a line
layout(location = kUniformTint) uniform vec4 tint;         // sRGB; opacity inside its vessel

in vec2 at;
in vec2 behind;
in float ink;

const float kBehind = 0.07; // opacity behind another vessel

void main() {
    float pixel_mm = pixel_size(at.y), depth = mm_behind(at.y);
    float seen = ink * (depth <= max(1.5 * pixel_mm, behind.x) ? 1.0 : depth <= behind.y + pixel_mm ? tint.a : kBehind);
    colour = seen * inked(tint.rgb, at.x, half_picture.z, 0.5);
}
