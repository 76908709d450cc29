// Shadows in screen space: the share of the key light that visible surfaces hide from a point. Each pixel casts one ray
// to a point of the light, which is a disc. Points of the light and offsets of the ray's steps vary in sixteen ways
// within four by four pixels, and between the views of a refined picture; the blur of the occlusion averages them. Thus
// shadows have soft edges, and steps are invisible.

const int kShadowSteps = 16;

// How far shadows reach, mm.
INLINE Float shadow_reach(Float depth) { return 2.2F * depth_range.w * (picture.w > 0.5F ? Float(1.0F) : depth); }

INLINE Mask in_picture(Vec2 pixel) {
    return pixel.x >= 0.0F && pixel.y >= 0.0F && pixel.x < picture.x && pixel.y < picture.y;
}

// The hidden share at a point; `normal`: y up and z towards the eye. `ray`: see shadow_ray(). Distant occluders hide
// less.
INLINE Float shadowed(Vec3 position, Vec3 normal, vec4 ray) {
    Float reach = shadow_reach(position.z), least = 0.012F * reach, hidden = 0.0F;
    Vec3 start = position + least * Vec3(normal.x, normal.y, -normal.z);
    Vec3 way = reach * Vec3(ray.x, ray.y, -ray.z);
    float per_edge = 1.0F / 0.016F;
    for (int i = 0; i < kShadowSteps; ++i) {
        float part = (float(i) + ray.w) / float(kShadowSteps), t = part * (0.3F + 0.7F * part);
        Vec3 at = start + t * way;
        Vec2 pixel = pixel_of(at);
        Float before = (at.z - opaque_depth_at(pixel)) * reciprocal(reach);
        Float inside = clamp((before - 0.004F) * per_edge, 0.0F, 1.0F);
        Float near = clamp(mad(-2.0F, before, 2.0F), 0.0F, 1.0F);
        hidden = max(hidden, select(in_picture(pixel), inside * near * (1.0F - t), 0.0F));
    }
    return hidden;
}
