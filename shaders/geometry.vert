// Vessel surface to clip space. Positions are relative to the middle of the mesh, so that single precision is enough
// wherever the tree lies.
#version 450 core
// Variants: PANE for glass; OPAQUE_SIDE and GLASS_SIDE for branches where glass meets what is opaque.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in int branch;

layout(location = 0) uniform mat4 to_clip;
layout(location = 1) uniform mat3 to_eye; // rotation only

out vec3 normal_eye;
#ifdef PANE
noperspective centroid out float depth_value;
#endif
flat out int branch_id;
#if defined(OPAQUE_SIDE) || defined(GLASS_SIDE)
#include "meeting.glsl"
out float glassy;
#endif

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    normal_eye = to_eye * normal;
    branch_id = branch;
#ifdef PANE
    depth_value = gl_Position.z / gl_Position.w;
#endif
#if defined(OPAQUE_SIDE) || defined(GLASS_SIDE)
    glassy = glassiness(branch, position);
#endif
}
