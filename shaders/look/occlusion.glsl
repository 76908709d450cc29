// Ambient occlusion in screen space: the share of the hemisphere over a point that its surroundings hide. Alchemy's
// estimator (McGuire et al., 2011) on a spiral of taps, rotated in sixteen ways within every four by four pixels; the
// blur, two successive boxes of four, averages them.

// Constants of a pixel, from the reach of the taps.
struct OcclusionScale {
    Float bias, softness;   // mm, mm^2
    Float fall_off_per_mm2; // a tap at twice the reach has weight 0
};

// Radius of the surroundings that count, mm.
INLINE Float occlusion_reach(Float depth) { return depth_range.w * (picture.w > 0.5F ? Float(1.0F) : depth); }

INLINE OcclusionScale occlusion_scale(Float depth) {
    Float reach = occlusion_reach(depth), squared = reach * reach;
    OcclusionScale scale;
    scale.bias = 0.02F * reach;
    scale.softness = 0.01F * squared;
    scale.fall_off_per_mm2 = 0.25F / squared;
    return scale;
}

// Adds what a tap at offset `way` hides; the normal has depth as +z as well.
INLINE Float with_tap(Float sum, Vec3 way, Vec3 normal, OcclusionScale scale) {
    Float squared = dot(way, way);
    Float weight = max(mad(-squared, scale.fall_off_per_mm2, 1.0F), 0.0F);
    Float over = max(dot(way, normal) - scale.bias, 0.0F);
    return mad(weight * over, rough_inversesqrt(squared + scale.softness), sum);
}

INLINE Float occlusion_of_sum(Float sum, float taps) { return clamp(sum * (2.4F / taps), 0.0F, 1.0F); }

// The blur removes the taps' noise without mixing a vessel with another behind it: the weight of a value `steps` pixels
// away and `deeper` by so many mm. `per_tolerance`: of the point, 1 / mm.
INLINE Float blur_tolerance_inverse(Float depth) { return 2.0F / occlusion_reach(depth); }
INLINE Float blur_weight(int steps, Float deeper, Float per_tolerance) {
    float centred = float(steps < 0 ? 4 + steps : 4 - steps);
    return centred * max(mad(-abs(deeper), per_tolerance, 1.0F), 0.0F);
}
