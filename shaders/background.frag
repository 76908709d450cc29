// The background.
#include "view.glsl"
#include "look.glsl"

layout(location = 0) out vec4 colour;

void main() {
    colour = background_top.w > 0.5 ? vec4(0.0) : vec4(background(gl_FragCoord.y / picture.y) + half_step(gl_FragCoord.xy), 1.0);
}
