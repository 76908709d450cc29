// Lines over the picture; fainter where vessels hide them.
#include "view.glsl"
#include "ink.glsl"

in vec3 at;
flat in vec3 ink;

void main() {
    float depth = picture.w > 0.5 ? at.z : 1.0 / at.z;
    float seen = mm_behind(depth) > 1.5 * pixel_size(depth) ? 0.34 : 1.0;
    colour = seen * inked(ink, at.x, at.y, 0.55);
}
