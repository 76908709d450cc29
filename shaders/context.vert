// Context meshes to clip space; positions are relative to the middle of the mesh.
#version 450 core
// Variants: TRANSPARENT for what is seen through; LINES for the edges of its triangles, whose corners then come three by three.
#include "bindings.glsl"

layout(location = kAttributePosition) in vec3 position;
layout(location = kAttributeNormal) in vec3 normal;

layout(location = kUniformToClip) uniform mat4 to_clip;
layout(location = kUniformToEye) uniform mat3 to_eye; // rotation only

out vec3 normal_eye;
#ifdef TRANSPARENT
noperspective centroid out float depth_value;
#endif
#ifdef LINES
noperspective out vec3 from_edges; // the share of the way to the corner across from each edge
#endif

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    normal_eye = to_eye * normal;
#ifdef TRANSPARENT
    depth_value = gl_Position.z / gl_Position.w;
#endif
#ifdef LINES
    int corner = gl_VertexID % 3;
    from_edges = vec3(corner == 0 ? 1.0 : 0.0, corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0);
#endif
}
