// Conversions between pixels and points. Eye space has depth as +z, mm.

// Size of a pixel at that depth, mm.
INLINE Float pixel_size(Float depth) { return pixel_to_eye.z * (picture.w > 0.5F ? Float(1.0F) : depth); }

INLINE Vec3 eye_position(Vec2 pixel, Float depth) {
    Float size = pixel_size(depth);
    return Vec3((pixel.x - pixel_to_eye.x) * size, (pixel.y - pixel_to_eye.y) * size, depth);
}

INLINE Vec2 pixel_of(Vec3 position) {
    float by_depth = 1.0F / pixel_to_eye.z;
    Float per_mm = picture.w > 0.5F ? Float(by_depth) : by_depth / position.z;
    return Vec2(mad(position.x, per_mm, pixel_to_eye.x), mad(position.y, per_mm, pixel_to_eye.y));
}

// Of unit length, z towards the eye.
INLINE Vec3 way_to_eye(Vec3 position) {
    if (picture.w > 0.5F) return Vec3(0.0F, 0.0F, 1.0F);
    return normalize(Vec3(-position.x, -position.y, position.z));
}

// 0 at the near end of the tree, 1 at its far end.
INLINE Float share_of_depth(Float depth) {
    return clamp((depth - depth_range.x) * (1.0F / (depth_range.y - depth_range.x)), 0.0F, 1.0F);
}

// Low-discrepancy noise over the picture (Jimenez, 2014): the same in every run.
INLINE Float noise(Vec2 pixel) {
    return fract(52.9829189F * fract(mad(pixel.x, 0.06711056F, pixel.y * 0.00583715F)));
}
