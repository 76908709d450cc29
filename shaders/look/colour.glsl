// Converts light to the picture's bytes.

// sRGB, `up` from 0 at the lower edge of the picture to 1 at the upper one.
INLINE Vec3 background(Float up) {
    return mix(Vec3(background_bottom), Vec3(background_top), smoothstep(0.0F, 1.0F, up));
}

// Dithering noise of half a byte step, against banding.
INLINE Float half_step(Vec2 pixel) {
    return (noise(Vec2(pixel.y + 17.0F, pixel.x + 17.0F)) - 0.5F) * (1.0F / 255.0F);
}

// Tone mapping with a soft shoulder, so that highlights do not clip.
INLINE Float toned(Float c) {
    Mask bright = c >= 0.72F;
    if (ANY(bright)) c = select(bright, mad(-0.28F, exp((0.72F - c) * (1.0F / 0.28F)), 1.0F), c);
    return clamp(c, 0.0F, 1.0F);
}

INLINE Float encoded_channel(Float c, Float dither) { return clamp(to_srgb(toned(c)) + dither, 0.0F, 1.0F); }

// From premultiplied linear light to premultiplied sRGB.
INLINE Vec4 encoded(Vec4 radiance, Float dither) {
    Float per_alpha = select(radiance.w > 0.0F, 1.0F / max(radiance.w, 1e-6F), 0.0F);
    return Vec4(encoded_channel(radiance.x * per_alpha, dither) * radiance.w,
                encoded_channel(radiance.y * per_alpha, dither) * radiance.w,
                encoded_channel(radiance.z * per_alpha, dither) * radiance.w, radiance.w);
}
