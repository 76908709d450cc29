// Transparent surfaces: premultiplied linear colours.

INLINE Vec4 veiled(Vec3 radiance, Float veil, Float shine) {
    return Vec4(radiance * veil + Vec3(shine), clamp(veil + shine, 0.0F, 1.0F));
}

// Grey glass: almost invisible where it faces the eye, a veil towards its outline.
INLINE Vec4 glass_veil(SurfacePoint p) {
    Mask hovered = has(p.flags, kHovered), glowing = has(p.flags, kGlowing);
    Vec3 tint = Vec3(glass_colour);
    tint = select(hovered, 1.6F * tint, tint);
    tint = select(glowing, 1.3F * tint, tint);
#ifdef CUTS
    Mask lost = has(p.flags, kLost);
    if (ANY(lost)) tint = select(lost, mix(tint, 1.4F * Vec3(lost_colour), 0.7F), tint);
#endif
    Float veil = mix(0.20F, 0.72F, pow(1.0F - facing_eye(p), 1.6F));
    veil = veil + select(hovered, 0.12F, 0.0F) + select(glowing, 0.06F, 0.0F);
    float opacity = more.y;
    veil = opacity < 1.0F ? veil * opacity : mix(veil, 0.97F, opacity - 1.0F);
    veil = veil * mad(-0.5F * background_bottom.w, p.far, 1.0F);
    // Any number of veils is no brighter than vessels in focus.
    Vec3 radiance = mad(0.28F, max(dot(p.normal, key_light()), 0.0F), 0.24F) * tint;
    return veiled(radiance, veil, min(opacity, 1.0F) * lights.w * 0.10F * to_60(mirrored(p, key_light())));
}

// Lesions and transparent context: a shell of constant thickness absorbs more light at grazing angles. Clear where it
// faces the eye, dense at its outline. `opacity` must be below 1.
INLINE Vec4 shell_veil(SurfacePoint p, Float opacity) {
    Float veil = 1.0F - pow(1.0F - opacity, reciprocal(mix(0.14F, 1.0F, facing_eye(p))));
    Float light = mad(0.85F, max(dot(p.normal, key_light()), 0.0F),
                      mad(0.15F, max(dot(p.normal, fill_light()), 0.0F), 0.45F));
    Vec3 radiance = fogged(light * p.albedo, p.far, 0.5F);
    return veiled(radiance, veil, lights.w * 0.22F * opacity * to_60(mirrored(p, key_light())));
}

// For a mesh drawn as lines, which cover `share` of the pixel.
INLINE Vec4 edge_veil(SurfacePoint p, Float share) { return Vec4(share * fogged_line(p.albedo, p.far), share); }
