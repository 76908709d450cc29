// Share of the ring around a pixel whose selection state differs from the pixel's.
INLINE Float outline(Vec2 pixel) {
    Mask inside = selected_at(pixel);
    Float differing = 0.0F;
    for (int i = 0; i < 12; ++i)
        differing = differing + select(selected_at(pixel + outline_step(i)) != inside, 1.0F, 0.0F);
    return smoothstep(0.0F, 3.0F, differing);
}

INLINE Vec4 outlined(Vec4 radiance, Float share) {
    return mix(radiance, Vec4(Vec3(selection_colour), 1.0F), 0.85F * share);
}
