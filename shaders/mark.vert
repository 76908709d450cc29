// Lines over the picture, as stripes that were laid out in pixels.
#version 450 core

layout(location = 0) in vec2 pixel;      // from the lower left
layout(location = 1) in vec3 stripe;     // pixels across from the middle, half the width, depth (its inverse in perspective)
layout(location = 2) in vec3 srgb;

layout(location = 0) uniform vec2 size; // of the picture in pixels

out vec3 at;
flat out vec3 ink;

void main() {
    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);
    at = stripe;
    ink = srgb;
}
