// Triangles where branches meet: says how far behind the branch that dominates each corner the three corners' branches
// are, in logarithms of their shares in the field, which are nearly linear over a triangle. A point belongs to the branch
// that is least behind there (border.glsl). On an edge that depends on the edge's ends alone, so that borders run on from
// triangle to triangle.
// Variants: TRANSPARENT for glass; VALUE for surfaces with a value for each vertex.

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
centroid out vec2 clip_depth; // as geometry.vert has it
#endif

// At corner a, of corner b's branch. Of a branch that is not among those that are told it is no more than the last.
float share(int a, int b) {
    if (corner_branch[a] == corner_branch[b]) return 0.0;
    uint mark = uint(corner_branch[b]) & 255u;
    uvec4 dominance = corner_dominance[a];
    // Never a tie: the corner itself is its own branch's.
    return -float(max(dominance.z == mark ? dominance.x : dominance.y, 1u));
}

void main() {
    for (int corner = 0; corner < 3; ++corner) {
        gl_Position = gl_in[corner].gl_Position;
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
