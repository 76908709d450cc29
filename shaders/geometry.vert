// Surfaces to clip space. Positions are relative to the middle of the mesh, so that single precision is enough wherever
// it lies.
// Variants: TRANSPARENT for what is seen through; BORDER for triangles where branches meet (border.geom goes on); CONTEXT
// for meshes beside the tree, LINES for the edges of their triangles, whose corners then come three by three; VALUE for
// surfaces with a value for each vertex.

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
// What is linear in the picture, as depth is, Mesa 22 interpolates wrongly where a corner of the picture cuts a triangle.
// So its numerator and denominator go through, which are linear on the triangle.
#ifdef TRANSPARENT
centroid out vec2 clip_depth; // z and w
#endif
#ifdef LINES
out vec4 from_edges; // the share of the way to the corner across from each edge, and 1, times w: see clip_depth
#endif
#endif

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
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
