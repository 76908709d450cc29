// Centerlines, and with RINGS the circles of the radius around them, as stripes of constant width in the picture: two
// triangles a segment, joined by mitres so that no pixel is drawn twice.
#version 450 core
#include "bindings.glsl"

#ifdef RINGS
layout(binding = kUnitRings) uniform samplerBuffer rings;  // centre and radius; axis
layout(binding = kUnitSeenRings) uniform usamplerBuffer seen; // which of them
layout(location = kUniformRingSteps) uniform vec2 ring_steps;     // corners of a ring; pixels below which it fades
#else
layout(binding = kUnitLinePoints) uniform samplerBuffer points;
layout(binding = kUnitLineDetails) uniform usamplerBuffer details; // bits of the diameter, branch
#endif

layout(location = kUniformToClip) uniform mat4 to_clip;
layout(location = kUniformHalfPicture) uniform vec3 half_picture; // half the size in pixels, half the width of a line
layout(location = kUniformToDepth) uniform vec4 to_depth;     // from mm to mm along the line of sight

out vec2 at;    // pixels across from the middle, mm along the line of sight
out vec2 behind; // mm behind a surface that it still lies on it, and that it still lies in its own vessel
out float ink;  // how much of it there is

vec2 pixel_of(vec4 p) { return p.xy / p.w * half_picture.xy; }

// Across the stripe at `here`, as long as the mitre takes; `before` and `after` are its neighbours, or itself at ends.
vec2 across(vec2 before, vec2 here, vec2 after) {
    vec2 a = here - before, b = after - here;
    a = length(a) > 1e-4 ? normalize(a) : vec2(0.0);
    b = length(b) > 1e-4 ? normalize(b) : a;
    if (a == vec2(0.0)) a = b;
    vec2 sum = a + b;
    float squared = dot(sum, sum);
    vec2 along = squared > 0.35 ? 2.0 * sum / squared : b; // a sharp turn is cut off
    return vec2(-along.y, along.x);
}

void main() {
    int corner = gl_VertexID % 6;
    bool second = corner == 1 || corner == 2 || corner == 4;
    float side = corner == 0 || corner == 1 || corner == 3 ? -1.0 : 1.0;
    vec4 own, before, after;
    bool there = true;
#ifdef RINGS
    int steps = int(ring_steps.x), segment = gl_VertexID / 6;
    int ring = int(texelFetch(seen, segment / steps).x), turn = segment % steps + (second ? 1 : 0);
    vec4 circle = texelFetch(rings, 2 * ring);
    vec3 axis = texelFetch(rings, 2 * ring + 1).xyz;
    vec3 u = normalize(cross(axis, abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0))), v = cross(axis, u);
    // A turn of this corner, and of a step: its neighbours follow from both.
    float angle = 6.28318531 * float(turn % steps) / float(steps), step_angle = 6.28318531 / float(steps);
    vec2 here = vec2(cos(angle), sin(angle)), one = vec2(cos(step_angle), sin(step_angle));
    vec2 back = vec2(here.x * one.x + here.y * one.y, here.y * one.x - here.x * one.y);
    vec2 on = vec2(here.x * one.x - here.y * one.y, here.y * one.x + here.x * one.y);
    vec4 centre = to_clip * vec4(circle.xyz, 1.0);
    vec4 right = to_clip * vec4(circle.w * u, 0.0), up = to_clip * vec4(circle.w * v, 0.0);
    vec3 position = circle.xyz + circle.w * (here.x * u + here.y * v);
    before = centre + back.x * right + back.y * up;
    own = centre + here.x * right + here.y * up;
    after = centre + on.x * right + on.y * up;
    float pixels = circle.w * length(vec3(to_clip[0].y, to_clip[1].y, to_clip[2].y)) / own.w * half_picture.y;
    ink = smoothstep(ring_steps.y, 2.2 * ring_steps.y, pixels);
    behind = circle.w * vec2(0.25, 2.5);
    there = before.w > before.z && own.w > own.z && after.w > after.z;
#else
    int segment = gl_VertexID / 6;
    int last = textureSize(details) - 1;
    uint branch = texelFetch(details, segment).y;
    vec3 from = texelFetch(points, segment).xyz, to = texelFetch(points, segment + 1).xyz;
    vec4 a = to_clip * vec4(from, 1.0), b = to_clip * vec4(to, 1.0);
    // The near plane cuts what reaches behind it.
    float before_a = a.w - a.z, before_b = b.w - b.z;
    there = branch == texelFetch(details, segment + 1).y && (before_a > 0.0 || before_b > 0.0);
    vec3 position = second ? to : from;
    if (before_a < 0.0) {
        a = mix(a, b, before_a / (before_a - before_b));
        if (!second) position = mix(from, to, before_a / (before_a - before_b));
    } else if (before_b < 0.0) {
        b = mix(b, a, before_b / (before_b - before_a));
        if (second) position = mix(to, from, before_b / (before_b - before_a));
    }
    own = second ? b : a;
    int neighbour = clamp(second ? segment + 2 : segment - 1, 0, last);
    vec4 next = to_clip * vec4(texelFetch(points, neighbour).xyz, 1.0);
    bool joins = texelFetch(details, neighbour).y == branch && next.w > next.z && before_a > 0.0 && before_b > 0.0;
    before = second ? a : joins ? next : a;
    after = second ? (joins ? next : b) : b;
    behind = vec2(0.0, 0.7 * uintBitsToFloat(texelFetch(details, second ? segment + 1 : segment).x));
    ink = 1.0;
#endif
    at = vec2(side * (half_picture.z + 2.0), dot(to_depth, vec4(position, 1.0)));
    gl_Position = own;
    gl_Position.xy += at.x * across(pixel_of(before), pixel_of(own), pixel_of(after)) / half_picture.xy * own.w;
    gl_Position.z = 0.5 * own.w; // nothing tests it
    if (!there) gl_Position = vec4(0.0, 0.0, -2.0, 1.0); // outside, all six
}
