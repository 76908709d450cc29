// GLSL 3.30 neither reads values at samples nor writes to chosen ones. Where an opaque triangle is cut in two, it is
// drawn once for each sample, with a sample mask: this tells on which side of the cut that sample lies.
layout(location = 6) uniform vec2 sample_place; // from the pixel's middle, in pixels

// Above 0 where `value` is, at the sample: over w, values are linear in the picture.
float side_at_sample(float value) {
    float over_w = value * gl_FragCoord.w;
    return over_w + dot(sample_place, vec2(dFdx(over_w), dFdy(over_w)));
}
