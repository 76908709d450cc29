// The interface: triangles in its own coordinates, whose origin is at the top left.

layout(location = kAttributePosition) in vec2 position;
layout(location = kAttributeUv) in vec2 uv;
layout(location = kAttributeColour) in vec4 colour;

layout(location = kUniformWindow) uniform vec4 window; // x, y, width, height

out vec2 vertex_uv;
out vec4 vertex_colour;

void main() {
    vec2 at = (position - window.xy) / window.zw;
    gl_Position = vec4(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0, 1.0);
    vertex_uv = uv;
    vertex_colour = colour;
}
