// Transforms surfaces to clip space. Positions are relative to the middle of the mesh, so that single precision
// suffices wherever it is. Variants: TRANSPARENT for transparent surfaces; BORDER for triangles where branches meet
// (followed by border.geom); CONTEXT for meshes next to the tree, LINES for the edges of their triangles, whose
// vertices are not shared; VALUE for surfaces with a value per vertex.

layout(location = kAttributePosition) in vec3 position;
layout(location = kAttributeNormal) in vec3 normal;
#ifndef CONTEXT
layout(location = kAttributeBranch) in int branch;
#endif
#ifdef BORDER
layout(location = kAttributeDominance) in uvec4 dominance; // as field::Dominance: over two rivals, and their marks
#endif
#ifdef VALUE
layout(location = kAttributeValue) in float value;
#endif

layout(location = kUniformToClip) uniform mat4 to_clip;
layout(location = kUniformToEye) uniform mat3 to_eye; // rotation only
layout(location = kUniformCut) uniform vec4 cut; // if clip distances are on

#ifdef BORDER
out vec3 corner_normal;
flat out uvec4 corner_dominance;
flat out int corner_branch;
#ifdef VALUE
out float corner_value;
#endif
#else
out vec3 normal_eye;
#ifdef VALUE
centroid out float value_here;
#endif
#ifndef CONTEXT
flat out int branch_id;
#endif
// Mesa 22 interpolates values that are linear in the picture, such as depth, wrongly if a corner of the picture clips
// the triangle. Therefore numerator and denominator are passed, which are linear on the triangle.
#ifdef TRANSPARENT
centroid out vec2 clip_depth; // z and w
#endif
#ifdef LINES
out vec4 from_edges; // barycentric coordinates and 1, times w: see clip_depth
#endif
#endif

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    gl_ClipDistance[0] = dot(cut, vec4(position, 1.0));
#ifdef BORDER
    corner_normal = to_eye * normal;
    corner_dominance = dominance;
    corner_branch = branch;
#ifdef VALUE
    corner_value = value;
#endif
#else
    normal_eye = to_eye * normal;
#ifdef VALUE
    value_here = value;
#endif
#ifndef CONTEXT
    branch_id = branch;
#endif
#ifdef TRANSPARENT
    clip_depth = gl_Position.zw;
#endif
#ifdef LINES
    from_edges = vec4(0.0, 0.0, 0.0, gl_Position.w);
    from_edges[gl_VertexID % 3] = gl_Position.w;
#endif
#endif
}
