// Puts slices among what was shaded without them, in the pixels that slices.frag leaves to this program. Where slices
// and surfaces meet, surfaces are shaded again, sample by sample. Glass is cut where the slice is.
layout(binding = kUnitImage) uniform sampler2D lit_without;

layout(location = kTargetSeenDepth) out float seen_depth;

#ifdef OUTLINE
// As outline() in look/outline.glsl, for selected vessels in front of the slice.
float outline_before(float depth, bool any) {
    ivec2 last = ivec2(picture.xy) - 1;
    float own = 0.0, selected = 0.0;
    for (int i = -1; i < (any ? 12 : -1); ++i) {
        vec2 at = i < 0 ? gl_FragCoord.xy : gl_FragCoord.xy + outline_step(i);
        bool here = selected_at(at) && opaque_depth_at(at) < depth;
        own = i < 0 && here ? 1.0 : own;
        selected += i >= 0 && here ? 1.0 : 0.0;
    }
    return smoothstep(0.0, 3.0, own > 0.5 ? 12.0 - selected : selected);
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z);
    Slices slices = slices_at(gl_FragCoord.xy, samples);
    float nearest = kNoSlice, opaque_values[kMostSamples];
    int sliced = 0;
    for (int s = 0; s < kMostSamples; ++s) {
        bool there = s < samples && texelFetch(surface_samples, pixel, s).x != 0u;
        opaque_values[s] = there ? sample_value(pixel, s) : 0.0;
        if (there && opaque_values[s] >= slices.value[s]) slices.value[s] = kNoSlice;
        nearest = max(nearest, slices.value[s]);
        sliced += slices.value[s] > kNoSlice ? 1 : 0;
    }
    float behind_all = texelFetch(opaque_depth, pixel, 0).x;
    seen_depth = sliced > 0 ? min(behind_all, eye_depth(nearest)) : behind_all;

    float share = 0.0; // of the pixel that shows a slice, as far as glass lets it through
    vec3 slice = vec3(0.0); // linear, as displayed
    vec4 rest = vec4(0.0);  // premultiplied linear light
#ifdef GLASS
    for (int s = 0; s < kMostSamples; ++s) opaque_values[s] = max(opaque_values[s], slices.value[s]);
    vec4 front[kMostSamples] = veils_before(opaque_values, sliced > 0);
#endif
    bool plain = sliced == samples; // one colour and nothing before it
    for (int s = 0; s < samples; ++s) {
        bool here = slices.value[s] > kNoSlice;
        float through = here ? 1.0 : 0.0;
        plain = plain && slices.colour[s] == slices.colour[0];
#ifdef GLASS
        rest += here ? front[s] : vec4(0.0);
        through *= 1.0 - front[s].a;
        plain = plain && front[s].a == 0.0;
#endif
        share += through;
        slice += through * to_linear(slices.colour[s]);
    }
    vec4 behind = background_top.w > 0.5 ? vec4(0.0) : vec4(to_linear(background(gl_FragCoord.y / picture.y)), 1.0);
    vec2 taken = taken_at(gl_FragCoord.xy);
    int rounds = sliced == 0 || sliced == samples ? 0 : samples;
    for (int s = 0; s < rounds; ++s) {
        uvec2 found = texelFetch(surface_samples, pixel, s).xy;
        vec3 normal = unpack_normal(found.y);
        vec3 position = eye_position(gl_FragCoord.xy, eye_depth(sample_value(pixel, s)));
        bool is_line = (found.x & kLine) != 0u;
        found.x &= ~(kLine | kCap);
        float own_value = 0.0;
#ifdef VALUES
        own_value = texelFetch(value_samples, pixel, s).x;
#endif
#ifdef SHADOWS
        taken = taken_beside(gl_FragCoord.xy, position.z);
#endif
        vec4 here = vec4(shade(max(found.x, 1u), normal, position, taken, own_value), 1.0);
        if (is_line) here.rgb = line_radiance(point_of_branch(found.x, normal, position));
        if (found.x == 0u) here = behind;
#ifdef GLASS
        here = front[s] + here * (1.0 - front[s].a);
#endif
        rest += slices.value[s] > kNoSlice ? vec4(0.0) : here;
    }
    float per_sample = 1.0 / float(samples);
    rest *= per_sample;
    slice *= per_sample;
    share *= per_sample;
#ifdef OUTLINE
    float ring = outline_before(eye_depth(nearest), sliced > 0);
    rest = outlined(rest, ring);
    slice *= 1.0 - 0.85 * ring;
    share *= 1.0 - 0.85 * ring;
    plain = plain && ring == 0.0;
#endif
    float alpha = rest.a + share;
    vec3 light = rest.a > 0.0 ? rest.rgb / rest.a : vec3(0.0);
    light = rest.a * vec3(toned(light.r), toned(light.g), toned(light.b)) + slice;
    vec3 bytes = to_srgb(light / max(alpha, 1e-6)) + (plain ? 0.0 : half_step(gl_FragCoord.xy));
    colour = vec4(clamp(plain ? slices.colour[0] : bytes, 0.0, 1.0), 1.0) * alpha;
    if (sliced == 0) colour = texelFetch(lit_without, pixel, 0);
}
