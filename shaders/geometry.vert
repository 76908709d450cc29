// Vessel surface to clip space. Positions are relative to the middle of the mesh, so that single precision is enough
// wherever the tree lies.
#version 450 core

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in int branch;

layout(location = 0) uniform mat4 to_clip;
layout(location = 1) uniform mat3 to_eye; // rotation only

out vec3 normal_eye;
flat out int branch_id;

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    normal_eye = to_eye * normal;
    branch_id = branch;
}
