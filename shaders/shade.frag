// Light, states and background: samples to the picture's colours. All light is reckoned in linear light; the result is
// sRGB with premultiplied alpha.
#version 450 core
#include "view.glsl"

layout(binding = 0) uniform usampler2DMS surface_samples;
layout(binding = 1) uniform sampler2DMS depth_samples;
layout(binding = 2) uniform usampler2DMS glass_samples;
layout(binding = 3) uniform sampler2DMS glass_depth_samples;
layout(binding = 4) uniform usampler2D id_normal;
layout(binding = 5) uniform sampler2D occlusion;
layout(binding = 6) uniform usamplerBuffer branches; // sRGB colour, and in alpha: 1 calm, 2 highlighted, 4 hovered, 8 selected

layout(std140, binding = 1) uniform Look {
    vec4 background_top;    // linear; w: 1 when transparent
    vec4 background_bottom; // linear; w: depth cue
    vec4 glass_colour;      // linear; w: 1 when there is any glass
    vec4 selection_colour;  // linear; w: outline's radius in pixels, 0 for none
    vec4 lights;            // key, fill, rim, specular
    vec4 more;              // occlusion strength
};

layout(location = 0) out vec4 colour;

const uint kCalm = 1u, kHighlighted = 2u, kHovered = 4u, kSelected = 8u;

vec3 to_linear(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(vec3(0.04045), c));
}

vec3 to_srgb(vec3 c) {
    return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), c));
}

vec3 background(vec2 pixel) {
    return mix(background_bottom.rgb, background_top.rgb, smoothstep(0.0, 1.0, pixel.y / picture.y));
}

struct Light {
    float diffuse;
    float specular;
};

Light lit(vec3 n, vec3 v, vec3 towards, float wrap, float shininess) {
    Light light;
    light.diffuse = max(0.0, (dot(n, towards) + wrap) / (1.0 + wrap));
    light.specular = pow(max(0.0, dot(n, normalize(towards + v))), shininess);
    return light;
}

// Lights are fixed to the viewer's head: a warm key from the upper left, a cool fill from the right, a rim of sky.
const vec3 kKey = vec3(-0.429, 0.572, 0.699);
const vec3 kFill = vec3(0.772, -0.051, 0.634);

vec3 shade(uint id, vec3 n, vec3 position, float occluded, vec2 pixel) {
    vec3 v = picture.w > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(vec3(-position.xy, position.z));
    uvec4 branch = texelFetch(branches, int(id) - 1);
    vec3 albedo = to_linear(vec3(branch.rgb) / 255.0);
    float facing = clamp(dot(n, v), 0.0, 1.0);
    if ((branch.a & kSelected) != 0u) albedo = mix(albedo, selection_colour.rgb, 0.62);
    if ((branch.a & kCalm) != 0u) albedo = mix(vec3(dot(albedo, vec3(0.2126, 0.7152, 0.0722))), albedo, 0.38) * 0.62;

    float open = 1.0 - more.x * occluded;
    Light key = lit(n, v, kKey, 0.15, 42.0), fill = lit(n, v, kFill, 0.35, 24.0);
    vec3 ambient = mix(vec3(0.115, 0.098, 0.100), vec3(0.235, 0.250, 0.285), 0.5 + 0.5 * n.y);
    float shadow = mix(1.0, open, 0.65); // the key is soft: what takes the sky takes some of it as well
    vec3 radiance = albedo * (1.85 * lights.x * key.diffuse * vec3(1.0, 0.965, 0.915) * shadow +
                              0.42 * lights.y * fill.diffuse * vec3(0.80, 0.90, 1.0) * open + ambient * 1.25 * open * open);
    radiance += lights.w * shadow * (0.155 * key.specular * vec3(1.0, 0.98, 0.95) + 0.03 * fill.specular);
    float edge = pow(1.0 - facing, 3.0);
    radiance += lights.z * edge * open * (0.16 * albedo + 0.022 * vec3(0.75, 0.87, 1.0)) * (0.6 + 0.4 * n.y);
    if ((branch.a & kHighlighted) != 0u) radiance = radiance * 1.12 + 0.05 * albedo;

    float far = clamp((position.z - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 1.0);
    float cue = background_bottom.w * ((branch.a & kHighlighted) != 0u ? 0.25 : 0.55) * far * far * (3.0 - 2.0 * far);
    radiance = mix(radiance, 0.5 * (background_top.rgb + background_bottom.rgb), cue);
    if ((branch.a & kHovered) != 0u) radiance += (0.10 + 0.55 * pow(1.0 - facing, 2.0)) * mix(albedo, vec3(0.8), 0.55);
    return radiance;
}

// Clear grey glass: nearly nothing where it faces the eye, a veil towards its outline.
vec4 glass(uint id, vec3 n, vec3 position) {
    vec3 v = picture.w > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(vec3(-position.xy, position.z));
    uvec4 branch = texelFetch(branches, int(id) - 1);
    float facing = clamp(dot(n, v), 0.0, 1.0);
    float veil = mix(0.10, 0.62, pow(1.0 - facing, 2.0));
    vec3 tint = glass_colour.rgb;
    if ((branch.a & kSelected) != 0u) tint = mix(tint, selection_colour.rgb, 0.7), veil += 0.12;
    if ((branch.a & kHovered) != 0u) tint *= 1.6, veil += 0.12;
    vec3 radiance = tint * (0.35 + 0.65 * max(0.0, dot(n, kKey)));
    float shine = lights.w * 0.35 * pow(max(0.0, dot(n, normalize(kKey + v))), 60.0);
    float far = clamp((position.z - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 1.0);
    veil *= 1.0 - 0.5 * background_bottom.w * far;
    return vec4(radiance * veil + shine, clamp(veil + shine, 0.0, 1.0));
}

// Share of the ring around the pixel that differs from it in being selected.
float outline(ivec2 pixel) {
    ivec2 last = ivec2(picture.xy) - 1;
    uint own = texelFetch(id_normal, pixel, 0).x;
    bool inside = own != 0u && (texelFetch(branches, int(own) - 1).a & kSelected) != 0u;
    float differing = 0.0;
    for (int i = 0; i < 12; ++i) {
        float angle = 0.5235988 * (float(i) + 0.5);
        ivec2 tap = clamp(pixel + ivec2(round(selection_colour.w * vec2(cos(angle), sin(angle)))), ivec2(0), last);
        uint id = texelFetch(id_normal, tap, 0).x;
        bool chosen = id != 0u && (texelFetch(branches, int(id) - 1).a & kSelected) != 0u;
        differing += chosen != inside ? 1.0 : 0.0;
    }
    return smoothstep(0.0, 3.0, differing);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z);
    bool transparent = background_top.w > 0.5;
    vec4 behind = transparent ? vec4(0.0) : vec4(background(gl_FragCoord.xy), 1.0);
    float occluded = texelFetch(occlusion, pixel, 0).x;

    uvec2 found[4];
    vec3 normals[4];
    float depths[4];
    int covered = 0;
    bool one_surface = true;
    for (int s = 0; s < samples; ++s) {
        found[s] = texelFetch(surface_samples, pixel, s).xy;
        one_surface = one_surface && found[s].x == found[0].x;
        if (found[s].x == 0u) continue;
        ++covered;
        normals[s] = unpack_normal(found[s].y);
        depths[s] = eye_depth(texelFetch(depth_samples, pixel, s).x);
        one_surface = one_surface && dot(normals[s], normals[0]) > 0.7;
    }
    bool any_glass = false;
    if (glass_colour.w > 0.5)
        for (int s = 0; s < samples; ++s) any_glass = any_glass || texelFetch(glass_samples, pixel, s).x != 0u;

    vec4 sum = vec4(0.0);
    if (covered == samples && one_surface && !any_glass) {
        vec3 n = vec3(0.0);
        float depth = 0.0;
        for (int s = 0; s < samples; ++s) n += normals[s], depth += depths[s];
        sum = vec4(shade(found[0].x, normalize(n), eye_position(gl_FragCoord.xy, depth / float(samples)), occluded,
                         gl_FragCoord.xy),
                   1.0);
    } else if (covered == 0 && !any_glass) {
        sum = behind;
    } else {
        for (int s = 0; s < samples; ++s) {
            vec4 here = behind;
            float front = 0.0;
            if (found[s].x != 0u) {
                here = vec4(shade(found[s].x, normals[s], eye_position(gl_FragCoord.xy, depths[s]), occluded, gl_FragCoord.xy), 1.0);
                front = texelFetch(depth_samples, pixel, s).x;
            }
            if (any_glass) {
                uvec2 pane = texelFetch(glass_samples, pixel, s).xy;
                float pane_depth = texelFetch(glass_depth_samples, pixel, s).x;
                if (pane.x != 0u && pane_depth > front) {
                    vec4 veil = glass(pane.x, unpack_normal(pane.y), eye_position(gl_FragCoord.xy, eye_depth(pane_depth)));
                    here = veil + here * (1.0 - veil.a);
                }
            }
            sum += here;
        }
        sum /= float(samples);
    }
    if (selection_colour.w > 0.0) {
        float line = 0.85 * outline(pixel);
        sum = mix(sum, vec4(selection_colour.rgb, 1.0), line);
    }
    // A soft shoulder keeps highlights from clipping; then sRGB, with noise of half a step against banding.
    vec3 straight = sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
    straight = mix(straight, 0.72 + 0.28 * (1.0 - exp(-(straight - 0.72) / 0.28)), step(vec3(0.72), straight));
    vec3 encoded = to_srgb(clamp(straight, 0.0, 1.0));
    if (sum.a > 0.0) encoded += (noise(gl_FragCoord.yx + 17.0) - 0.5) / 255.0;
    colour = vec4(clamp(encoded, 0.0, 1.0) * sum.a, sum.a);
}
