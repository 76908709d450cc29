// Centerlines as stripes of constant width in the picture: two triangles per segment.
#include "lines.glsl"
#include "stripe.glsl"

layout(location = kUniformToClip) uniform mat4 to_clip;
layout(location = kUniformHalfPicture) uniform vec3 half_picture; // half the size in pixels, half the width of a line

layout(location = kUniformCut) uniform vec4 cut; // if clip distances are on

out vec3 normal_eye;
flat out int branch_id;

void main() {
    branch_id = line_branch(segment);
    vec4 a = to_clip * vec4(line_point(segment), 1.0);
    vec4 b = to_clip * vec4(line_point(segment + 1), 1.0);
    // Clips at the near plane.
    float before_a = a.w - a.z, before_b = b.w - b.z;
    vec4 from = before_a < 0.0 ? mix(a, b, before_a / (before_a - before_b)) : a;
    vec4 to = before_b < 0.0 ? mix(b, a, before_b / (before_b - before_a)) : b;
    vec2 way = (to.xy / to.w - from.xy / from.w) * half_picture.xy;
    float way_length = length(way);
    vec2 along = way_length > 1e-4 ? way / way_length : vec2(1.0, 0.0);
    // Ends reach half a width farther, so that neighbours join.
    gl_Position = at_end ? to : from;
    vec2 offset = half_picture.z * (side * vec2(-along.y, along.x) + (at_end ? along : -along));
    gl_Position.xy += offset / half_picture.xy * gl_Position.w;
    if (branch_id != line_branch(segment + 1) || (before_a < 0.0 && before_b < 0.0)) gl_Position = kOutside;
    normal_eye = vec3(0.0, 0.0, 1.0);
    gl_ClipDistance[0] = dot(cut, vec4(line_point(at_end ? segment + 1 : segment), 1.0));
}
