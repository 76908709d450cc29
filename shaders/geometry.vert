// Vessel surface to clip space. Positions are relative to the middle of the mesh, so that single precision is enough
// wherever the tree lies.
#version 450 core
// Variants: TRANSPARENT for glass; BORDER for triangles where branches meet (border.geom goes on).
#include "bindings.glsl"

layout(location = kAttributePosition) in vec3 position;
layout(location = kAttributeNormal) in vec3 normal;
layout(location = kAttributeBranch) in int branch;
#ifdef BORDER
layout(location = kAttributeDominance) in uvec4 dominance; // as field::Dominance: over two rivals, and their marks
#endif

layout(location = kUniformToClip) uniform mat4 to_clip;
layout(location = kUniformToEye) uniform mat3 to_eye; // rotation only

#ifdef BORDER
out vec3 corner_normal;
flat out uvec4 corner_dominance;
flat out int corner_branch;
#else
out vec3 normal_eye;
flat out int branch_id;
#ifdef TRANSPARENT
noperspective centroid out float depth_value;
#endif
#endif

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
#ifdef BORDER
    corner_normal = to_eye * normal;
    corner_dominance = dominance;
    corner_branch = branch;
#else
    normal_eye = to_eye * normal;
    branch_id = branch;
#ifdef TRANSPARENT
    depth_value = gl_Position.z / gl_Position.w;
#endif
#endif
}
