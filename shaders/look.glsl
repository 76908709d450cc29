// Colours and lights of the frame, and the way from linear light to the picture's bytes.
#include "bindings.glsl"
layout(std140, binding = kBlockLook) uniform Look {
    vec4 background_top;    // sRGB; w: 1 when transparent
    vec4 background_bottom; // sRGB; w: depth cue
    vec4 glass_colour;      // linear; w: 1 when there is any glass
    vec4 selection_colour;  // linear; w: outline's radius in pixels, 0 for none
    vec4 lights;            // key, fill, rim, specular
    vec4 more;              // occlusion strength, glass opacity, pixels of the picture a point, strength of shadows
    vec4 line_colour;       // linear
    vec4 lesion_colour;     // linear; w: opacity where it faces the eye
    vec4 lost_colour;       // linear
    vec4 far_colour;        // linear: what the far end of the tree sinks into
    vec4 cues;              // strength of halos, contours, chromadepth; radius of halos in pixels
};

vec3 to_linear(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(vec3(0.04045), c));
}

vec3 to_srgb(vec3 c) {
    return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), c));
}

// sRGB.
vec3 background(vec2 pixel) {
    return mix(background_bottom.rgb, background_top.rgb, smoothstep(0.0, 1.0, pixel.y / picture.y));
}

// Noise of half a step of a byte, against banding.
float half_step(vec2 pixel) { return (noise(pixel.yx + 17.0) - 0.5) / 255.0; }

// A soft shoulder keeps highlights from clipping; then sRGB, then premultiplied alpha.
vec4 encoded(vec4 radiance, vec2 pixel) {
    vec3 straight = radiance.a > 0.0 ? radiance.rgb / radiance.a : vec3(0.0);
    straight = mix(straight, 0.72 + 0.28 * (1.0 - exp(-(straight - 0.72) / 0.28)), step(vec3(0.72), straight));
    vec3 bytes = to_srgb(clamp(straight, 0.0, 1.0)) + half_step(pixel);
    return vec4(clamp(bytes, 0.0, 1.0) * radiance.a, radiance.a);
}
