// Light. Lights are fixed to the viewer's head: a warm key from the upper left, a cool fill from the right, a rim of sky.
INLINE Vec3 key_light() { return Vec3(-0.429F, 0.572F, 0.699F); }
INLINE Vec3 fill_light() { return Vec3(0.772F, -0.051F, 0.634F); }

// Integer powers by multiplication: pow() takes a software rasteriser ten times as long.
INLINE Float to_8(Float x) {
    Float x2 = x * x, x4 = x2 * x2;
    return x4 * x4;
}
INLINE Float to_24(Float x) {
    Float x8 = to_8(x);
    return x8 * x8 * x8;
}
INLINE Float to_60(Float x) {
    Float x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x20 = x8 * x8 * x4;
    return x20 * x20 * x20;
}
INLINE Float to_70(Float x) {
    Float x2 = x * x, x8 = to_8(x), x16 = x8 * x8, x32 = x16 * x16;
    return x32 * x32 * (x2 * x2 * x2);
}

// `wrap`: light also reaches surfaces that are turned away.
INLINE Float diffuse(SurfacePoint p, Vec3 light, float wrap) {
    return max((dot(p.normal, light) + wrap) * (1.0F / (1.0F + wrap)), 0.0F);
}
// The base of a specular term, to be raised to a power.
INLINE Float mirrored(SurfacePoint p, Vec3 light) { return max(dot(p.normal, normalize(light + p.towards_eye)), 0.0F); }

INLINE Float facing_eye(SurfacePoint p) { return clamp(dot(p.normal, p.towards_eye), 0.0F, 1.0F); }

// `open`: visible share of the sky; `shadowed`: hidden share of the key light; `aside`: 0 where the surface faces the
// eye, 1 at its outline.
INLINE Vec3 lit(SurfacePoint p, Vec3 albedo, Float open, Float shadowed, Float aside) {
    Float shadow = mad(0.75F, open - 1.0F, 1.0F); // the key is soft: what hides the sky also hides part of it
    Float fill_share = 1.0F;
#ifdef SHADOWS
    if (more.w > 0.0F) {
        // Surfaces turned away from the key light get no shadow: otherwise the fill light would end where the vessel
        // turns.
        Float turned_to = clamp(2.5F * dot(p.normal, key_light()), 0.0F, 1.0F);
        Float taken = 0.85F * more.w * shadowed;
        shadow = shadow * (1.0F - taken);
        fill_share = mad(-0.45F * turned_to, taken, 1.0F);
    }
#endif
    Vec3 ambient = mix(Vec3(0.085F, 0.070F, 0.074F), Vec3(0.190F, 0.205F, 0.240F), mad(0.5F, p.normal.y, 0.5F));
    Float key = 1.50F * lights.x * (diffuse(p, key_light(), 0.06F) * shadow);
    Float fill = 0.34F * lights.y * (diffuse(p, fill_light(), 0.30F) * fill_share * open);
    Vec3 light = open * open * ambient + key * Vec3(1.0F, 0.965F, 0.915F) + fill * Vec3(0.80F, 0.90F, 1.0F);
    Float glint = 0.25F * to_70(mirrored(p, key_light())), sheen = 0.03F * to_24(mirrored(p, fill_light()));
    Vec3 shine = lights.w * shadow * Vec3(glint + sheen, mad(glint, 0.98F, sheen), mad(glint, 0.95F, sheen));
    Float rim = lights.z * (aside * aside * aside) * (open * mad(0.4F, p.normal.y, 0.6F));
    return albedo * light + shine + rim * (0.14F * albedo + Vec3(0.015F, 0.0174F, 0.020F));
}
