// Depth values of the samples of opaque surfaces. A closed surface that a plane cuts open would show its inside. A ray
// that comes through the plane into the surface leaves it once more than it enters it: there the plane is seen, as a cap.
// Those samples are marked (kCap) and have the plane's normal (begin_caps() in passes/gl_state.h); here they get its
// depth. A pixel has one value, that of its nearest corner, so that a slice of a scan in the same plane does not shine
// through.
#ifdef CAPS
layout(location = kUniformCapValues) uniform vec4 cap_values;
#endif

float sample_value(ivec2 pixel, int s) {
    float value = texelFetch(depth_samples, pixel, s).x;
#ifdef CAPS
    bool cap = (texelFetch(surface_samples, pixel, s).x & kCap) != 0u;
    if (cap) value = dot(cap_values.xyz, vec3(gl_FragCoord.xy, 1.0)) + cap_values.w;
#endif
    return value;
}
