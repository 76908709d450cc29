// Centerlines, and with RINGS circles of the radius around them, as stripes of constant width in the picture: two
// triangles per segment, with mitre joints so that no pixel is drawn twice.
#include "stripe.glsl"
#ifdef RINGS
layout(binding = kUnitRings) uniform samplerBuffer rings;  // centre and radius; axis
layout(binding = kUnitSeenRings) uniform usamplerBuffer seen; // which of them
layout(location = kUniformRingSteps) uniform vec2 ring_steps;     // corners of a ring; pixels below which it fades
#else
#include "lines.glsl"
#endif

layout(location = kUniformToClip) uniform mat4 to_clip;
layout(location = kUniformHalfPicture) uniform vec3 half_picture; // half the size in pixels, half the width of a line
layout(location = kUniformToDepth) uniform vec4 to_depth;     // from mm to mm along the line of sight
layout(location = kUniformCut) uniform vec4 cut; // if clip distances are on

out vec2 at;    // pixels across from the middle, mm along the line of sight
out vec2 behind; // mm behind a surface: limit for lying on it, and for lying inside its own vessel
out float ink;  // opacity

vec2 pixel_of(vec4 p) { return p.xy / p.w * half_picture.xy; }

// Vector across the stripe at `here`, with the length of the mitre; `before` and `after`: neighbours, or `here` itself
// at ends.
vec2 across(vec2 before, vec2 here, vec2 after) {
    vec2 a = here - before, b = after - here;
    a = length(a) > 1e-4 ? normalize(a) : vec2(0.0);
    b = length(b) > 1e-4 ? normalize(b) : a;
    if (a == vec2(0.0)) a = b;
    vec2 sum = a + b;
    float squared = dot(sum, sum);
    vec2 along = squared > 0.35 ? 2.0 * sum / squared : b; // bevel at sharp turns
    return vec2(-along.y, along.x);
}

void main() {
    vec4 own, before, after;
    bool there = true;
#ifdef RINGS
    int steps = int(ring_steps.x);
    int ring = int(texelFetch(seen, segment / steps).x), turn = segment % steps + (at_end ? 1 : 0);
    vec4 circle = texelFetch(rings, 2 * ring);
    vec3 axis = texelFetch(rings, 2 * ring + 1).xyz;
    vec3 u = normalize(cross(axis, abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0))), v = cross(axis, u);
    // Rotation of this corner, and of one step, which gives its neighbours.
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
    int last = textureSize(line_details) - 1, branch = line_branch(segment);
    vec3 from = line_point(segment), to = line_point(segment + 1);
    vec4 a = to_clip * vec4(from, 1.0), b = to_clip * vec4(to, 1.0);
    // Clips at the near plane.
    float before_a = a.w - a.z, before_b = b.w - b.z;
    there = branch == line_branch(segment + 1) && (before_a > 0.0 || before_b > 0.0);
    vec3 position = at_end ? to : from;
    if (before_a < 0.0) {
        a = mix(a, b, before_a / (before_a - before_b));
        if (!at_end) position = mix(from, to, before_a / (before_a - before_b));
    } else if (before_b < 0.0) {
        b = mix(b, a, before_b / (before_b - before_a));
        if (at_end) position = mix(to, from, before_b / (before_b - before_a));
    }
    own = at_end ? b : a;
    int neighbour = clamp(at_end ? segment + 2 : segment - 1, 0, last);
    vec4 next = to_clip * vec4(line_point(neighbour), 1.0);
    bool joins = line_branch(neighbour) == branch && next.w > next.z && before_a > 0.0 && before_b > 0.0;
    before = at_end ? a : joins ? next : a;
    after = at_end ? (joins ? next : b) : b;
    behind = vec2(0.0, 0.7 * line_diameter(at_end ? segment + 1 : segment));
    ink = 1.0;
#endif
    gl_ClipDistance[0] = dot(cut, vec4(position, 1.0));
    at = vec2(side * (half_picture.z + 2.0), dot(to_depth, vec4(position, 1.0)));
    gl_Position = own;
    gl_Position.xy += at.x * across(pixel_of(before), pixel_of(own), pixel_of(after)) / half_picture.xy * own.w;
    gl_Position.z = 0.5 * own.w; // not tested
    if (!there) gl_Position = kOutside;
}
