// Lines over the picture, as stripes laid out in pixels.

layout(location = kAttributePixel) in vec2 pixel;  // from the lower left
layout(location = kAttributeStripe) in vec3 stripe; // pixels across from the middle, half the width, depth (its inverse in perspective)
layout(location = kAttributeInk) in vec3 srgb;

layout(location = kUniformSize) uniform vec2 size; // of the picture in pixels

out vec3 at;
flat out vec3 ink;

void main() {
    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);
    at = stripe;
    ink = srgb;
}
