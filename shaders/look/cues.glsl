// Depth cues and states of branches: chromadepth, contours, fog, halos, highlights. To add a cue: a function here and a
// line in radiance_of().

// Chromadepth: red seems near and blue far, by the eye's lens and by habit. Linear, about equally bright.
INLINE Vec3 chromatic(Float far) {
    Vec3 near_red = Vec3(0.78F, 0.045F, 0.03F), violet = Vec3(0.42F, 0.05F, 0.36F), blue = Vec3(0.035F, 0.11F, 0.72F);
    Float twice = far + far;
    return select(far < 0.5F, mix(near_red, violet, twice), mix(violet, blue, twice - 1.0F));
}

// The colour before lighting: the material's, modified by depth and by the state of the branch.
INLINE Vec3 shown_colour(SurfacePoint p) {
    Mask selected = has(p.flags, kSelected), calm = has(p.flags, kCalm);
    Vec3 colour = material_colour(p);
#ifdef CHROMADEPTH
    if (cues.z > 0.0F)
        colour = select(has(p.flags, kHighlighted) || p.fixed_colour, colour, mix(colour, chromatic(p.far), cues.z));
#endif
    // The outline shows the selection; the colour still shows the branch's state.
    if (ANY(selected)) {
        Float share = select(has(p.flags, kHighlighted), Float(0.0F), Float(0.62F));
        colour = select(selected, mix(colour, Vec3(selection_colour), share), colour);
    }
    if (ANY(calm)) {
        Float grey = dot(colour, Vec3(0.2126F, 0.7152F, 0.0722F));
        colour = select(calm, 0.62F * mix(Vec3(grey), colour, 0.38F), colour);
    }
    return colour;
}

// Darkness where the surface turns away from the eye.
INLINE Float contour(Float facing) { return mad(-0.85F * cues.y, 1.0F - smoothstep(0.12F, 0.42F, facing), 1.0F); }

// Fades far points into the background by `strength`.
INLINE Vec3 fogged(Vec3 radiance, Float far, Float strength) {
    return mix(radiance, Vec3(far_colour), background_bottom.w * strength * (far * sqrt(far)));
}
// Fog for lines and edges, which are thin: linear in the depth.
INLINE Vec3 fogged_line(Vec3 radiance, Float far) {
    return mix(radiance, Vec3(far_colour), 0.62F * background_bottom.w * far);
}

// Glow of the hovered branch and its dependents.
INLINE Vec3 glow(SurfacePoint p, Vec3 albedo, Float aside) {
    Mask hovered = has(p.flags, kHovered), glowing = has(p.flags, kGlowing);
    Vec3 sum = Vec3(0.0F);
    if (ANY(hovered))
        sum = select(hovered, mad(0.55F, aside * aside, 0.10F) * mix(albedo, Vec3(0.8F), 0.55F), sum);
    if (ANY(glowing))
        sum = sum + select(glowing, mad(0.30F, aside * aside, 0.03F) * mix(albedo, Vec3(0.8F), 0.35F), Vec3(0.0F));
    return sum;
}

// The share of the ring around a point that shows something nearer, increasing with the distance behind it: the halo
// that a vessel casts on what it passes (Bruckner and Groeller, 2007, for volumes).
#ifdef HALOS
INLINE Float halo(SurfacePoint p) {
    float least = 0.006F * (depth_range.y - depth_range.x), slope = 1.0F / (11.0F * least);
    Float sum = 0.0F;
    for (int i = 0; i < 12; ++i) {
        Float before = p.position.z - opaque_depth_at(p.pixel + halo_step(i));
        sum = sum + clamp((before - least) * slope, 0.0F, 1.0F);
    }
    return clamp(sum * (1.0F / 3.0F), 0.0F, 1.0F);
}
#endif

#ifdef SHADOWS
// Occlusion and shadow of a sample on an edge. The pixel has the values of its nearest surface; a sample of a surface
// behind uses a neighbouring pixel that shows this surface.
INLINE Vec2 taken_beside(Vec2 pixel, Float depth) {
    Float least = abs(opaque_depth_at(pixel) - depth) - 0.1F * depth_range.w * (picture.w > 0.5F ? Float(1.0F) : depth);
    Vec2 from = pixel;
    for (int i = 0; i < 4; ++i) {
        Vec2 beside = pixel + Vec2(float(i / 2 * (2 * i - 5)), float((1 - i / 2) * (2 * i - 1)));
        Float apart = abs(opaque_depth_at(beside) - depth);
        from = select(apart < least, beside, from);
        least = min(apart, least);
    }
    return taken_at(from);
}
#endif

// Radiance of an opaque surface towards the eye, linear. `taken`: hidden shares of the sky and of the key light.
INLINE Vec3 radiance_of(SurfacePoint p, Vec2 taken) {
    Mask highlighted = has(p.flags, kHighlighted);
    Vec3 albedo = shown_colour(p);
    Float facing = facing_eye(p), aside = 1.0F - facing;
    Vec3 radiance = lit(p, albedo, 1.0F - more.x * taken.x, taken.y, aside);
    if (ANY(highlighted)) radiance = select(highlighted, 1.10F * radiance + 0.05F * albedo, radiance);
#ifdef CONTOURS
    if (cues.y > 0.0F) radiance = contour(facing) * radiance;
#endif
    radiance = fogged(radiance, p.far, select(highlighted, 0.25F, 0.68F));
    radiance = radiance + glow(p, albedo, aside);
#ifdef HALOS
    if (cues.x > 0.0F) radiance = mad(-0.9F * cues.x, halo(p), 1.0F) * radiance;
#endif
    return radiance;
}

// Centerlines inside glass are not lit; only fog applies.
INLINE Vec3 line_radiance(SurfacePoint p) {
    Vec3 radiance = Vec3(line_colour);
    radiance = select(has(p.flags, kHovered), mix(radiance, Vec3(1.0F, 0.85F, 0.55F), 0.6F), radiance);
    radiance = select(has(p.flags, kLost), mix(radiance, Vec3(lost_colour), 0.6F), radiance);
    return fogged_line(radiance, p.far);
}
