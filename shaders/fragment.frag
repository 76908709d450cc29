// Outputs a fragment of glass, for the list of its pixel or for a layer (glass_output.glsl). Variant: BORDER for
// triangles where branches meet, of which samples of glass branches are drawn.
#include "glass_output.glsl"

in vec3 normal_eye;
#ifdef BORDER
#include "border.glsl"
#else
flat in int branch_id;
#endif

void main() {
    // The normal is that at the pixel's centre: beyond the triangle's edge it continues like the next triangle's.
    // Back faces are drawn where glass is cut open.
    uint normal = packSnorm2x16(octahedral(normalize(gl_FrontFacing ? normal_eye : -normal_eye)));
#ifndef BORDER
    add_fragment(uint(branch_id + 1), normal, covered_samples());
#elif defined(FALLBACK)
    int branch = -1, glass = 0; // the last glass branch of the samples: a fragment has only one
    for (int s = 0; s < samples; ++s) {
        int here = branch_ids[owner(shares_at(sample_positions[s]))];
        bool is_glass = layer_of(here) == 1u;
        branch = is_glass ? here : branch;
        glass |= (is_glass ? 1 : 0) << s;
    }
    add_fragment(uint(branch + 1), normal, glass);
#else
    // One fragment per glass branch; a branch with two corners uses the first of them.
    ivec3 covered = ivec3(0);
    for (int s = 0; s < samples; ++s) covered[owner(interpolateAtSample(shares, s))] |= covered_samples() & (1 << s);
    for (int corner = 0; corner < 3; ++corner)
        if (layer_of(branch_ids[corner]) == 1u) add_fragment(uint(branch_ids[corner] + 1), normal, covered[corner]);
#endif
}
