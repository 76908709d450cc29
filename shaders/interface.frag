// The interface: letters and icons come from `image`; plain areas use a white spot in it.

layout(binding = kUnitImage) uniform sampler2D image;

in vec2 vertex_uv;
in vec4 vertex_colour;

layout(location = 0) out vec4 colour;

void main() { colour = vertex_colour * texture(image, vertex_uv); }
