// Context meshes to clip space; positions are relative to the middle of the mesh.
#version 450 core
// Variants: PANE for what is seen through; LINES for the edges of its triangles, whose corners then come three by three.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

layout(location = 0) uniform mat4 to_clip;
layout(location = 1) uniform mat3 to_eye; // rotation only

out vec3 normal_eye;
#ifdef PANE
noperspective centroid out float depth_value;
#endif
#ifdef LINES
noperspective out vec3 from_edges; // the share of the way to the corner across from each edge
#endif

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    normal_eye = to_eye * normal;
#ifdef PANE
    depth_value = gl_Position.z / gl_Position.w;
#endif
#ifdef LINES
    int corner = gl_VertexID % 3;
    from_edges = vec3(corner == 0 ? 1.0 : 0.0, corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0);
#endif
}
