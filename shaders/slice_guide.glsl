// For each pixel the depth values of its nearest and its farthest sample, larger is nearer. A slice before or behind
// both needs no more. Where glass or an outline of the selection lies over the pixel, every slice must be put among them
// sample by sample: the values then contain all others.
layout(location = 0) out vec2 guide;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z);
    float nearest = -1e20, farthest = 1e20;
    for (int s = 0; s < samples; ++s) {
        float value = sample_value(pixel, s);
        value = value > 0.0 ? value : -1e20; // planes beyond the far plane have values below 0
        nearest = max(nearest, value);
        farthest = min(farthest, value);
    }
    bool special = false;
#ifdef GLASS
#ifdef FALLBACK
    special = true;
#else
    special = heads[list_of(pixel)] != 0u;
#endif
#endif
#ifdef OUTLINE
    special = special || selected_at(gl_FragCoord.xy) || outline(gl_FragCoord.xy) > 0.0;
#endif
    guide = special ? vec2(1e25, -1e25) : vec2(nearest, farthest);
}
