// GLSL of the viewer. The formulas of the look (light, glass, depth cue, occlusion, tone) and their constants are those
// of ramus' folder shaders/look, so that the page and ramus draw the same picture. Eye space has depth as +z, mm.

const kHead = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
precision highp sampler2D;
`;

// Flags of a record; draw.js sets them.
export const kFlags = { calm: 1, highlighted: 2, hovered: 4, selected: 8, lost: 16, cut: 32, glowing: 64, fixed: 128 };
const kFlagText = Object.entries(kFlags).map(([name, bit]) => `const uint k_${name} = ${bit}u;`).join("\n");

const kOctahedral = `
float with_sign(float size, float of) { return of >= 0.0 ? size : -size; }
uint packed(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  vec2 p = n.xy;
  if (n.z < 0.0) p = vec2(with_sign(1.0 - abs(n.y), n.x), with_sign(1.0 - abs(n.x), n.y));
  return packSnorm2x16(p);
}
vec3 unpacked(uint bits) {
  vec2 p = unpackSnorm2x16(bits);
  float z = 1.0 - abs(p.x) - abs(p.y), fold = max(-z, 0.0);
  return normalize(vec3(p.x - with_sign(fold, p.x), p.y - with_sign(fold, p.y), z));
}`;

// range: near and far plane. picture: width, height, parallel. eye: pixel of the middle, mm per pixel at depth 1 (or at any).
// tree: near and far end of the tree, reach of the occlusion in pixels, the same in mm at depth 1.
const kView = `
uniform vec2 range;
uniform vec3 picture, eye;
uniform vec4 tree;
float depth_of(float value) {
  float n = range.x, f = range.y;
  return picture.z > 0.5 ? n + value * (f - n) : f * n / (f - value * (f - n));
}
float by_depth(float depth) { return picture.z > 0.5 ? 1.0 : depth; }
vec3 position_at(vec2 pixel, float depth) { return vec3((pixel - eye.xy) * eye.z * by_depth(depth), depth); }
vec3 way_to_eye(vec3 p) { return picture.z > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(vec3(-p.xy, p.z)); }
float share_of_depth(float depth) { return clamp((depth - tree.x) / (tree.y - tree.x), 0.0, 1.0); }
`;

// Roots instead of a power, which a software rasteriser takes ten times as long for: within 0.7 of a byte.
const kColour = `
vec3 to_srgb(vec3 c) {
  vec3 a = sqrt(c), b = sqrt(a), d = sqrt(b);
  return 0.662002687 * a + 0.684122060 * b - 0.323583601 * d - 0.0225411470 * c;
}
`;

const kLight = `
const vec3 kKey = vec3(-0.429, 0.572, 0.699), kFill = vec3(0.772, -0.051, 0.634);
float to_8(float x) { float x2 = x * x, x4 = x2 * x2; return x4 * x4; }
float to_24(float x) { float x8 = to_8(x); return x8 * x8 * x8; }
float to_60(float x) { float x2 = x * x, x4 = x2 * x2, x20 = to_8(x2) * x4; return x20 * x20 * x20; }
float to_70(float x) { float x2 = x * x, x32 = to_8(x2 * x2); return x32 * x32 * x2 * x2 * x2; }
float mirrored(vec3 n, vec3 to_eye, vec3 light) { return max(dot(n, normalize(light + to_eye)), 0.0); }
vec3 lit(vec3 n, vec3 to_eye, vec3 albedo, float open, float aside) {
  float shadow = 1.0 + 0.75 * (open - 1.0);
  vec3 ambient = mix(vec3(0.085, 0.070, 0.074), vec3(0.190, 0.205, 0.240), 0.5 + 0.5 * n.y);
  float key = 1.5 * max((dot(n, kKey) + 0.06) / 1.06, 0.0) * shadow;
  float fill = 0.34 * max((dot(n, kFill) + 0.30) / 1.30, 0.0) * open;
  vec3 light = open * open * ambient + key * vec3(1.0, 0.965, 0.915) + fill * vec3(0.80, 0.90, 1.0);
  float glint = 0.25 * to_70(mirrored(n, to_eye, kKey)), sheen = 0.03 * to_24(mirrored(n, to_eye, kFill));
  vec3 shine = shadow * vec3(glint + sheen, 0.98 * glint + sheen, 0.95 * glint + sheen);
  float rim = aside * aside * aside * open * (0.6 + 0.4 * n.y);
  return albedo * light + shine + rim * (0.14 * albedo + vec3(0.015, 0.0174, 0.020));
}
`;

// Linear colour and flags of branches, then of meshes, by id - 1.
const kRecords = `
uniform usampler2D records;
${kFlagText}
uvec4 record_of(uint id) { int i = max(int(id) - 1, 0); return texelFetch(records, ivec2(i & 1023, i >> 10), 0); }
bool has(uint bits, uint bit) { return (bits & bit) != 0u; }
`;

export const kSurfaceVertex = `${kHead}
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in uint branch;
layout(location = 3) in vec2 values;
uniform mat4 to_clip;
uniform mat3 to_eye;
uniform uint mesh; // its id, or 0 for vessels
out vec3 eye_normal;
flat out uint id;
out vec2 value;
void main() {
  gl_Position = to_clip * vec4(position, 1.0);
  eye_normal = to_eye * normal.xyz;
  id = mesh == 0u ? branch + 1u : mesh;
  value = values;
}`;

// A centerline inside glass: four corners per segment, a stripe of constant width in the picture.
export const kLineVertex = `${kHead}${kRecords}
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in uint branch;
uniform mat4 to_clip;
uniform vec3 half_picture; // half the size in pixels, half the width of a line
uniform usampler2D layers; // by branch: 1 for glass
out vec3 eye_normal;
flat out uint id;
out vec2 value;
void main() {
  vec4 a = to_clip * vec4(from, 1.0), b = to_clip * vec4(to, 1.0);
  float before_a = a.w + a.z, before_b = b.w + b.z; // in front of the near plane: above 0
  bool end = (gl_VertexID & 1) == 1;
  vec4 p = before_a < 0.0 ? mix(a, b, before_a / (before_a - before_b)) : a;
  vec4 q = before_b < 0.0 ? mix(b, a, before_b / (before_b - before_a)) : b;
  vec2 way = (q.xy / q.w - p.xy / p.w) * half_picture.xy;
  vec2 ahead = length(way) > 1e-4 ? normalize(way) : vec2(1.0, 0.0);
  float side = gl_VertexID < 2 ? -1.0 : 1.0;
  gl_Position = end ? q : p;
  gl_Position.xy += half_picture.z * (side * vec2(-ahead.y, ahead.x) + (end ? ahead : -ahead)) / half_picture.xy * gl_Position.w;
  if (before_a < 0.0 && before_b < 0.0) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  if (texelFetch(layers, ivec2(int(branch) & 1023, int(branch) >> 10), 0).r != 1u) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  eye_normal = vec3(0.0, 0.0, 1.0);
  id = (branch + 1u) | 0x80000000u;
  value = vec2(0.0);
}`;

// What a fragment of a surface knows.
const kFragment = `
uniform int drop; // leave out what lies beyond a cut
in vec3 eye_normal;
flat in uint id;
in vec2 value;
void leave_out() {
  if (drop == 1 && value.y > 0.0) discard;
}
`;

// The visible surface: id and normal; values along branches.
export const kSurfaceFragment = `${kHead}${kOctahedral}${kFragment}
layout(location = 0) out uvec2 surface;
layout(location = 1) out vec2 value_here;
void main() {
  leave_out();
  vec3 n = gl_FrontFacing ? normalize(eye_normal) : vec3(0.0, 0.0, 1.0);
  surface = uvec2(id, packed(n));
  value_here = value;
}`;

// Ids alone, for picking.
export const kIdFragment = `${kHead}${kFragment}
layout(location = 0) out uvec2 surface;
void main() {
  leave_out();
  surface = uvec2(id, 0u);
}`;

// Glass: sums that do not depend on the order of layers. rgb: light by weight, a: what is let through; second: weights.
export const kGlassFragment = `${kHead}${kView}${kLight}${kRecords}${kFragment}
uniform vec3 glass_colour, lost_colour, far_colour;
uniform vec2 strength; // depth cue, opacity of glass
uniform float opacity; // of a mesh; 0: glass
uniform float weight_unit;
layout(location = 0) out vec4 light_sum;
layout(location = 1) out vec4 weight_sum;
void main() {
  leave_out();
  vec3 n = normalize(eye_normal), p = position_at(gl_FragCoord.xy, depth_of(gl_FragCoord.z));
  vec3 to_eye = way_to_eye(p);
  float facing = clamp(dot(n, to_eye), 0.0, 1.0), far = share_of_depth(p.z), veil, shine;
  uvec4 record = record_of(id);
  vec3 radiance;
  if (opacity > 0.0) {
    vec3 albedo = vec3(record.rgb) / 65535.0;
    if (has(record.a, k_hovered)) albedo *= 1.25;
    veil = 1.0 - pow(1.0 - opacity, 1.0 / mix(0.14, 1.0, facing));
    float light = 0.85 * max(dot(n, kKey), 0.0) + 0.15 * max(dot(n, kFill), 0.0) + 0.45;
    radiance = mix(light * albedo, far_colour, strength.x * 0.5 * far * sqrt(far));
    shine = 0.22 * opacity * to_60(mirrored(n, to_eye, kKey));
  } else {
    vec3 tint = glass_colour;
    if (has(record.a, k_hovered)) tint *= 1.6;
    if (has(record.a, k_glowing)) tint *= 1.3;
    if (has(record.a, k_selected)) tint = mix(tint, vec3(0.107, 0.604, 1.0), 0.5);
    bool lost = has(record.a, k_lost) || (has(record.a, k_cut) && value.y > 0.0);
    if (lost) tint = mix(tint, 1.4 * lost_colour, 0.7);
    veil = mix(0.20, 0.72, pow(1.0 - facing, 1.6));
    veil += (has(record.a, k_hovered) ? 0.12 : 0.0) + (has(record.a, k_glowing) ? 0.06 : 0.0);
    veil = strength.y < 1.0 ? veil * strength.y : mix(veil, 0.97, strength.y - 1.0);
    veil *= 1.0 - 0.5 * strength.x * far;
    radiance = (0.28 * max(dot(n, kKey), 0.0) + 0.24) * tint;
    shine = min(strength.y, 1.0) * 0.10 * to_60(mirrored(n, to_eye, kKey));
  }
  float alpha = clamp(veil + shine, 0.0, 1.0);
  float near = 1.0 - 0.9 * far, weight = weight_unit * (0.02 + near * near * near * near);
  light_sum = vec4(weight * (radiance * veil + shine), alpha);
  weight_sum = vec4(weight * alpha);
}`;

export const kScreenVertex = `${kHead}
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

export const kOcclusionFragment = `${kHead}${kOctahedral}${kView}
uniform usampler2D surface;
uniform sampler2D depths;
uniform int taps;
uniform float turn; // of a sixteenth of the way around
layout(location = 0) out vec4 hidden;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float value = texelFetch(depths, pixel, 0).x, sum = 0.0;
  vec3 centre = position_at(gl_FragCoord.xy, depth_of(value));
  vec3 n = unpacked(texelFetch(surface, pixel, 0).y) * vec3(1.0, 1.0, -1.0);
  float reach = tree.w * by_depth(centre.z), bias = 0.02 * reach, softness = 0.01 * reach * reach, fall_off = 0.25 / (reach * reach);
  int fine = ((pixel.y & 1) << 1) | ((pixel.y >> 1) & 1);
  float angle = 0.39269908 * (float(4 * ((pixel.x + pixel.y) & 3) + fine) + turn);
  vec2 direction = vec2(cos(angle), sin(angle));
  const mat2 kGolden = mat2(-0.73736887, 0.67549029, -0.67549029, -0.73736887);
  ivec2 last = ivec2(picture.xy) - 1;
  for (int i = value < 1.0 ? 0 : taps; i < taps; ++i) {
    float part = (float(i) + 0.5) / float(taps);
    ivec2 tap = pixel + ivec2(round(tree.z * part * sqrt(part) * direction));
    direction = kGolden * direction;
    if (clamp(tap, ivec2(0), last) != tap) continue;
    float there = texelFetch(depths, tap, 0).x;
    if (there >= 1.0) continue;
    vec3 way = position_at(vec2(tap) + 0.5, depth_of(there)) - centre;
    float squared = dot(way, way);
    sum += max(1.0 - squared * fall_off, 0.0) * max(dot(way, n) - bias, 0.0) * inversesqrt(squared + softness);
  }
  hidden = vec4(clamp(sum * 2.4 / float(taps), 0.0, 1.0));
}`;

export const kBlurFragment = `${kHead}${kView}
uniform sampler2D occlusion, depths;
uniform ivec2 step_by;
layout(location = 0) out vec4 hidden;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = ivec2(picture.xy) - 1;
  float value = texelFetch(depths, pixel, 0).x, sum = 0.0, weights = 1e-9;
  float depth = depth_of(value), per_tolerance = 2.0 / (tree.w * by_depth(depth));
  for (int i = value < 1.0 ? -3 : 4; i <= 3; ++i) {
    ivec2 tap = clamp(pixel + i * step_by, ivec2(0), last);
    float weight = float(4 - abs(i)) * max(1.0 - abs(depth_of(texelFetch(depths, tap, 0).x) - depth) * per_tolerance, 0.0);
    sum += weight * texelFetch(occlusion, tap, 0).x;
    weights += weight;
  }
  hidden = vec4(sum / weights);
}`;

// Light of a pixel, linear and toned; views with shifted pixels are summed. Software rasterisers execute both sides of a
// branch, but leave loops early: what few pixels need is in a loop of one round.
export const kShadeFragment = `${kHead}${kOctahedral}${kView}${kLight}${kRecords}
uniform usampler2D surface;
uniform sampler2D depths, occlusion, values, glass_light, glass_weight, ramp, sky; // ramp and sky: linear colours
uniform vec3 far_colour, line_colour, lost_colour, selection_colour;
uniform vec2 strength;
uniform float outline, point, share;
uniform int glass;
uniform vec4 scale; // low, 1 / (high - low), logarithmic; 1 if colours follow a value
uniform int bands;
uniform vec4 band[8]; // linear colour, outer distance in mm
layout(location = 0) out vec4 colour;
vec3 ramp_colour(float t) { return texture(ramp, vec2((clamp(t, 0.0, 1.0) * 63.0 + 0.5) / 64.0, 0.5)).rgb; }
float pixel_size(float depth) { return eye.z * by_depth(depth); }
vec3 shown(uvec4 record, vec2 value, float depth) {
  uint flags = record.a;
  vec3 own = vec3(record.rgb) / 65535.0, result = own;
  bool by_value = !has(flags, k_highlighted) && !has(flags, k_fixed);
  for (int k = scale.w > 0.5 && by_value ? 1 : 0; k > 0; --k) {
    float v = scale.z > 0.5 ? log(max(value.x, 1e-12)) : value.x;
    result = ramp_colour((v - scale.x) * scale.y);
  }
  float per_pixel = 1.0 / pixel_size(depth);
  for (int k = bands > 0 && by_value ? 1 : 0; k > 0; --k) {
    float edge = 2.0;
    for (int i = bands - 1; i >= 0; --i) {
      float inside = (band[i].w - value.x) * per_pixel;
      result = mix(result, band[i].rgb, clamp(inside + 0.5, 0.0, 1.0));
      edge = min(edge, abs(inside) / point);
    }
    result *= mix(0.45, 1.0, smoothstep(0.5, 1.3, edge));
  }
  for (int k = has(flags, k_lost | k_cut) ? 1 : 0; k > 0; --k) {
    float behind = has(flags, k_lost) ? 1e9 : value.y;
    float across = fract((gl_FragCoord.x + gl_FragCoord.y) / (9.0 * point));
    float stripe = smoothstep(0.0, 0.16, across) * (1.0 - smoothstep(0.34, 0.5, across));
    result = mix(result, mix(0.50, 1.35, stripe) * lost_colour, clamp(behind * per_pixel + 0.5, 0.0, 1.0));
    result = mix(vec3(0.92), result, smoothstep(0.8, 1.6, abs(behind) * per_pixel / point));
  }
  if (has(flags, k_selected)) result = mix(result, selection_colour, has(flags, k_highlighted) ? 0.0 : 0.62);
  if (has(flags, k_calm)) result = 0.62 * mix(vec3(dot(result, vec3(0.2126, 0.7152, 0.0722))), result, 0.38);
  return result;
}
vec3 fogged(vec3 radiance, float far, float by) { return mix(radiance, far_colour, strength.x * by * far * sqrt(far)); }
vec3 glow(uint flags, vec3 albedo, float aside) {
  vec3 sum = vec3(0.0);
  if (has(flags, k_hovered)) sum = (0.10 + 0.55 * aside * aside) * mix(albedo, vec3(0.8), 0.55);
  if (has(flags, k_glowing)) sum += (0.03 + 0.30 * aside * aside) * mix(albedo, vec3(0.8), 0.35);
  return sum;
}
bool selected_at(ivec2 at) {
  uint id = texelFetch(surface, clamp(at, ivec2(0), ivec2(picture.xy) - 1), 0).x;
  return id != 0u && id < 0x80000000u && has(record_of(id).a, k_selected);
}
vec3 toned(vec3 c) {
  for (int k = any(greaterThan(c, vec3(0.72))) ? 1 : 0; k > 0; --k) c = mix(c, 1.0 - 0.28 * exp((0.72 - c) / 0.28), vec3(greaterThanEqual(c, vec3(0.72))));
  return clamp(c, 0.0, 1.0);
}
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 found = texelFetch(surface, pixel, 0).xy;
  vec3 light = texture(sky, vec2(0.5 / 64.0 + 63.0 / 64.0 * gl_FragCoord.y / picture.y, 0.5)).rgb;
  for (int k = found.x != 0u ? 1 : 0; k > 0; --k) {
    vec3 p = position_at(gl_FragCoord.xy, depth_of(texelFetch(depths, pixel, 0).x));
    uvec4 record = record_of(found.x & 0x7fffffffu);
    float far = share_of_depth(p.z);
    if (found.x >= 0x80000000u) {
      light = line_colour;
      if (has(record.a, k_hovered)) light = mix(light, vec3(1.0, 0.85, 0.55), 0.6);
      if (has(record.a, k_selected)) light = mix(light, selection_colour, 0.6);
      if (has(record.a, k_lost)) light = mix(light, lost_colour, 0.6);
      light = mix(light, far_colour, 0.62 * strength.x * far);
    } else {
      vec3 n = unpacked(found.y), to_eye = way_to_eye(p);
      vec3 albedo = shown(record, texelFetch(values, pixel, 0).xy, p.z);
      float aside = 1.0 - clamp(dot(n, to_eye), 0.0, 1.0);
      light = lit(n, to_eye, albedo, 1.0 - texelFetch(occlusion, pixel, 0).x, aside);
      bool bright = has(record.a, k_highlighted);
      if (bright) light = 1.10 * light + 0.05 * albedo;
      light = fogged(light, far, bright ? 0.25 : 0.68);
      if (has(record.a, k_hovered | k_glowing)) light += glow(record.a, albedo, aside);
    }
  }
  bool bare = found.x == 0u; // the background keeps its colour, also white
  for (int k = glass; k > 0; --k) {
    vec4 sum = texelFetch(glass_light, pixel, 0);
    float weight = texelFetch(glass_weight, pixel, 0).x;
    light = light * sum.a + (weight > 0.0 ? sum.rgb / weight * (1.0 - sum.a) : vec3(0.0));
    bare = bare && weight == 0.0;
  }
  for (int k = outline > 0.0 ? 1 : 0; k > 0; --k) {
    bool inside = selected_at(pixel);
    float differing = 0.0;
    for (int i = 0; i < 12; ++i) {
      float angle = 0.5235988 * (float(i) + 0.5);
      if (selected_at(pixel + ivec2(round(outline * vec2(cos(angle), sin(angle))))) != inside) differing += 1.0;
    }
    light = mix(light, selection_colour, 0.85 * smoothstep(0.0, 3.0, differing));
    bare = bare && differing == 0.0;
  }
  colour = vec4(bare ? light : toned(light), 1.0);
}`;

// The mean of the summed views as sRGB, with noise against banding.
export const kPresentFragment = `${kHead}${kColour}
uniform sampler2D picture;
uniform vec2 scale; // from pixels of the canvas to the used part of the texture
uniform float share; // 1 / number of views
layout(location = 0) out vec4 colour;
float noise(vec2 p) { return fract(52.9829189 * fract(0.06711056 * p.x + 0.00583715 * p.y)); }
void main() {
  vec3 light = share * texture(picture, gl_FragCoord.xy * scale).rgb;
  float dither = (noise(gl_FragCoord.yx + 17.0) - 0.5) / 255.0;
  colour = vec4(clamp(to_srgb(light) + dither, 0.0, 1.0), 1.0);
}`;
