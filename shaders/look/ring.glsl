// Offsets from a pixel to the twelve around it that outlines and halos sample. The same for all pixels: no vectors.
vec2 ring_step(int i, float reach) {
    float angle = 0.5235988F * (float(i) + 0.5F);
    return round(reach * vec2(cos(angle), sin(angle)));
}
vec2 outline_step(int i) { return ring_step(i, selection_colour.w); }
vec2 halo_step(int i) { return ring_step(i, cues.w * ((i & 1) == 0 ? 1.0F : 0.55F)); }
