// For triangles where branches meet: outputs how far the branches of the three corners are behind the dominant branch
// of each corner, in logarithms of their shares in the field, which are nearly linear over a triangle. A point belongs
// to the branch that is least behind (border.glsl). On an edge this depends only on the edge's ends, so borders are
// continuous across triangles. Variants: TRANSPARENT for glass; VALUE for surfaces with a value per vertex.

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in vec3 corner_normal[];
flat in uvec4 corner_dominance[]; // over two rivals, and the lowest bytes of their ids
flat in int corner_branch[];
#ifdef VALUE
in float corner_value[];
#endif

out vec3 normal_eye;
out vec3 shares; // of the corners' branches
flat out ivec3 branch_ids;
#ifdef VALUE
centroid out float value_here;
#endif
#ifdef TRANSPARENT
centroid out vec2 clip_depth; // see geometry.vert
#endif

// The share at corner a of corner b's branch. A branch that is not among the known rivals has at most the last one's
// share.
float share(int a, int b) {
    if (corner_branch[a] == corner_branch[b]) return 0.0;
    uint mark = uint(corner_branch[b]) & 255u;
    uvec4 dominance = corner_dominance[a];
    // Avoids ties: a corner belongs to its own branch.
    return -float(max(dominance.z == mark ? dominance.x : dominance.y, 1u));
}

void main() {
    for (int corner = 0; corner < 3; ++corner) {
        gl_Position = gl_in[corner].gl_Position;
        gl_ClipDistance[0] = gl_in[corner].gl_ClipDistance[0];
        normal_eye = corner_normal[corner];
        shares = vec3(share(corner, 0), share(corner, 1), share(corner, 2));
        branch_ids = ivec3(corner_branch[0], corner_branch[1], corner_branch[2]);
#ifdef VALUE
        value_here = corner_value[corner];
#endif
#ifdef TRANSPARENT
#ifdef FULL_DEPTH
        clip_depth = vec2(0.5 * (gl_Position.z + gl_Position.w), gl_Position.w);
#else
        clip_depth = gl_Position.zw;
#endif
#endif
        EmitVertex();
    }
    EndPrimitive();
}
