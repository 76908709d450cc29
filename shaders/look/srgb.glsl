// Conversion between sRGB and linear light.

INLINE Float to_linear(Float c) {
    return select(c <= 0.04045F, c * (1.0F / 12.92F), pow((c + 0.055F) * (1.0F / 1.055F), 2.4F));
}
INLINE Vec3 to_linear(Vec3 c) { return Vec3(to_linear(c.x), to_linear(c.y), to_linear(c.z)); }

INLINE Float to_srgb(Float c) {
    return select(c <= 0.0031308F, c * 12.92F, mad(1.055F, pow(c, 1.0F / 2.4F), -0.055F));
}
INLINE Vec3 to_srgb(Vec3 c) { return Vec3(to_srgb(c.x), to_srgb(c.y), to_srgb(c.z)); }
