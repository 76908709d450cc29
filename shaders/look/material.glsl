// The colour of a surface before lighting: its branch's, by a value, or by its distance from lesions; lost parts are
// dark and hatched.

#ifdef SCALE
// Linear. Points without a value keep their own colour.
INLINE Vec3 colour_on_scale(SurfacePoint p) {
    Float value = value_on_scale(p);
    Mask known = value > kLeastKnown;
    if (scale.z > 0.5F) value = log(max(value, 1e-12F));
    return select(known, to_linear(ramp_colour(clamp((value - scale.x) * scale.y, 0.0F, 1.0F))), p.albedo);
}
#endif

#ifdef MARGINS
INLINE Float distance_to_lesions(Vec3 position) {
    Float nearest = 1e30F;
    for (int i = 0; i < int(counts.x); ++i) {
        vec4 sphere = lesion_sphere(i);
        nearest = min(nearest, length(position - Vec3(sphere)) - sphere.w);
    }
    if (counts.w > 0.5F) nearest = min(nearest, distance_in_grid(position));
    return nearest;
}

// Linear. Bands have antialiased borders with a thin dark line. Beyond the last band the branch has its own colour.
INLINE Vec3 margin_colour(SurfacePoint p) {
    Float mm = distance_to_lesions(p.position), per_pixel = reciprocal(pixel_size(p.position.z)), edge = 2.0F;
    Vec3 colour = p.albedo;
    for (int i = int(counts.z) - 1; i >= 0; --i) {
        Float inside = (margins[i].w - mm) * per_pixel;
        colour = mix(colour, Vec3(margins[i]), clamp(inside + 0.5F, 0.0F, 1.0F));
        edge = min(edge, abs(inside) * (1.0F / more.z));
    }
    return mix(0.45F, 1.0F, smoothstep(0.5F, 1.3F, edge)) * colour;
}
#endif

#ifdef CUTS
// Distance in mm outside an end of a lost part. Near the end its plane decides; farther away the distance along the
// branch, which may turn back.
INLINE Float outward_of(int end, Float from_root, Vec3 position) {
    vec4 centre = cut_texel(end), along = cut_texel(end + 1); // w: radius at the end; distance from the root, mm
    Float way = from_root - along.w;
    return select(abs(way) < 2.5F * centre.w, dot(position - Vec3(centre), Vec3(along)), way);
}

// Distance inside the lost part of the branch, in mm; negative outside.
INLINE Float behind_cut(SurfacePoint p) {
    Float inside = -1e30F, from_root = root_distance(p);
    for (int i = 0; i < int(counts.y); ++i) {
        vec4 part = cut_texel(5 * i);
        Mask own = p.id == uint(part.x) + 1U;
        if (!ANY(own)) continue;
        Float from = part.y > 0.5F ? outward_of(5 * i + 1, from_root, p.position) : Float(1e30F);
        Float to = part.z > 0.5F ? -outward_of(5 * i + 3, from_root, p.position) : Float(1e30F);
        inside = select(own, max(inside, min(from, to)), inside);
    }
    return inside;
}

// Lost parts are dark and hatched, with a plain ring at the cut.
INLINE Vec3 colour_of_lost(SurfacePoint p, Vec3 kept) {
    Mask cut = has(p.flags, kCut);
    Float behind = select(has(p.flags, kLost), 1e30F, -1e30F);
    if (ANY(cut)) behind = select(cut, max(behind, behind_cut(p)), behind);
    Float across = fract((p.pixel.x + p.pixel.y) * (1.0F / (9.0F * more.z)));
    Float stripe = smoothstep(0.0F, 0.16F, across) * (1.0F - smoothstep(0.34F, 0.5F, across));
    Vec3 hatched = mix(0.50F, 1.35F, stripe) * Vec3(lost_colour);
    Float per_pixel = reciprocal(pixel_size(p.position.z));
    Vec3 colour = mix(kept, hatched, clamp(mad(behind, per_pixel, 0.5F), 0.0F, 1.0F));
    Float from_cut = abs(behind) * (per_pixel * (1.0F / more.z)); // points of the picture
    return mix(Vec3(0.92F), colour, smoothstep(0.8F, 1.6F, from_cut));
}
#endif

INLINE Vec3 material_colour(SurfacePoint p) {
    Vec3 colour = p.albedo;
#if defined(SCALE) || defined(MARGINS)
    Mask by_value = !(has(p.flags, kHighlighted) || p.fixed_colour);
#endif
#ifdef SCALE
    if (scale.w > 0.5F && ANY(by_value)) colour = select(by_value, colour_on_scale(p), colour);
#endif
#ifdef MARGINS
    if (counts.z > 0.5F && ANY(by_value)) colour = select(by_value, margin_colour(p), colour);
#endif
#ifdef CUTS
    Mask lost = has(p.flags, kLost | kCut);
    if (ANY(lost)) colour = select(lost, colour_of_lost(p, colour), colour);
#endif
    return colour;
}
