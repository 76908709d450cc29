// A unit vector as two numbers from -1 to 1 (Cigolle et al., 2014).
INLINE Vec2 octahedral(Vec3 n) {
    Float scale = reciprocal(abs(n.x) + abs(n.y) + abs(n.z));
    Vec2 p = Vec2(n.x * scale, n.y * scale);
    Vec2 folded = Vec2(with_sign(1.0F - abs(p.y), p.x), with_sign(1.0F - abs(p.x), p.y));
    return select(n.z < 0.0F, folded, p);
}

INLINE Vec3 from_octahedral(Vec2 p) {
    Float z = 1.0F - (abs(p.x) + abs(p.y)), fold = max(-z, 0.0F);
    return normalize(Vec3(p.x - with_sign(fold, p.x), p.y - with_sign(fold, p.y), z));
}
