// Composes one layer of glass with the previous ones, sample by sample: what shade.frag does with a list, one fragment
// at a time. The pixel's fragments come in the order of their depths, so a sample waits while an earlier fragment
// belongs to another sample.
#ifdef CAPS
layout(binding = kUnitFirstFragments) uniform usampler2DMS opaque_ids; // their depths are those of the caps' insides
#endif

layout(location = 0) out vec4 fronts[kMostSamples]; // premultiplied; blended behind the existing colour

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z);
    float nearest = 0.0;
    for (int s = 0; s < samples; ++s) nearest = max(nearest, texelFetch(depth_samples, pixel, s).x);
    if (nearest == 0.0) discard;
    uvec2 fragments[kMostSamples];
    bool hit[kMostSamples];
    uint covered = 0u, before = 0u;
#ifdef PLANES
    Slices slices = slices_at(gl_FragCoord.xy, samples);
#endif
    for (int s = 0; s < kMostSamples; ++s) {
        hit[s] = s < samples && texelFetch(depth_samples, pixel, s).x == nearest;
        fragments[s] = hit[s] ? texelFetch(surface_samples, pixel, s).xy : uvec2(0u);
        covered |= (hit[s] ? 1u : 0u) << s;
        before |= fragments[s].x >> kBeforeShift;
    }
    // Opaque surfaces hide it at every covered sample: no fragment.
    if ((covered & before & 15u) == 0u) discard;
    vec3 position = eye_position(gl_FragCoord.xy, eye_depth(nearest));
    uvec2 last = uvec2(0u);
    vec4 veil = vec4(0.0);
    for (int s = 0; s < kMostSamples; ++s) {
        hit[s] = hit[s] && ((fragments[s].x >> (kGlassShift + s)) & 1u) != 0u && nearest > texelFetch(opaque_samples, pixel, s < samples ? s : 0).x;
#ifdef CAPS
        bool cap = (texelFetch(opaque_ids, pixel, s < samples ? s : 0).x & kCap) != 0u;
        hit[s] = hit[s] && (!cap || nearest > dot(cap_values.xyz, vec3(gl_FragCoord.xy, 1.0)) + cap_values.w);
#endif
#ifdef PLANES
        hit[s] = hit[s] && nearest > slices.value[s];
#endif
        if (hit[s] && fragments[s] != last) {
            last = fragments[s];
            veil = veil_of(last.x, last.y, position);
        }
        fronts[s] = hit[s] ? veil : vec4(0.0);
    }
}
