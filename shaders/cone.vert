// Draws a rectangle around one segment of a centerline as a round cone: the hull of the two balls at its ends.
// cone.frag intersects the ray through each pixel with it.
#include "view.glsl"
#include "lines.glsl"
#include "stripe.glsl"

layout(location = kUniformLinesToEye) uniform mat4 to_eye; // the lines' positions to eye space, depth as +z
layout(location = kUniformZoom) uniform vec2 zoom;        // eye xy (at depth 1 when perspective) to clip space

out vec2 through; // where the ray goes through: eye xy, at depth 1 when perspective
flat out vec3 from, to;
flat out vec2 radii;
flat out vec4 from_way, to_way; // the vessel's direction at both ends; w: 1 if it continues
flat out int branch_id;

vec3 position_of(int point) { return (to_eye * vec4(line_point(point), 1.0)).xyz; }

// At a joint the direction is the mean of both segments' directions.
vec4 way_at(int joint, int beyond, vec3 axis, float outward) {
    if (beyond < 0 || line_branch(beyond) != branch_id) return vec4(axis, 0.0);
    vec3 other = outward * (position_of(beyond) - position_of(joint));
    return dot(other, other) > 0.0 ? vec4(normalize(axis + normalize(other)), 1.0) : vec4(axis, 1.0);
}

// Half the width of a ball's outline as seen from the eye, at depth 1: the longer semi-axis of the ellipse.
float outline(vec3 centre, float radius) {
    float away = length(centre), sine = radius / away, cosine = sqrt(max(1.0 - sine * sine, 0.0));
    float slope = length(centre.xy) / away, straight = centre.z / away;
    return sine / (straight * (straight * cosine - slope * sine));
}

void main() {
    branch_id = line_branch(segment);
    from = position_of(segment);
    to = position_of(segment + 1);
    vec3 axis = distance(from, to) > 0.0 ? normalize(to - from) : vec3(0.0, 0.0, 1.0);
    int last = textureSize(line_points) - 1;
    from_way = way_at(segment, segment - 1, axis, -1.0);
    to_way = way_at(segment + 1, segment + 2 <= last ? segment + 2 : -1, axis, 1.0);
    radii = 0.5 * vec2(line_diameter(segment), line_diameter(segment + 1));
    bool flat_view = picture.w > 0.5;
    vec2 a = flat_view ? from.xy : from.xy / from.z, b = flat_view ? to.xy : to.xy / to.z;
    float reach = flat_view ? max(radii.x, radii.y) : max(outline(from, radii.x), outline(to, radii.y));
    reach += pixel_to_eye.z; // a pixel's width
    vec2 along = distance(a, b) > 1e-6 * reach ? normalize(b - a) : vec2(1.0, 0.0);
    // The ball at a joint belongs to the segment before it.
    bool first = segment == 0 || line_branch(segment - 1) != branch_id;
    float back = first ? reach : pixel_to_eye.z;
    through = (at_end ? b + reach * along : a - back * along) + side * reach * vec2(-along.y, along.x);
    gl_Position = vec4(through * zoom, 0.5, 1.0);
    // Segments that reach behind the eye have no outline, and the step from a branch to the next is no segment.
    bool behind = !flat_view && min(from.z - 1.05 * radii.x, to.z - 1.05 * radii.y) <= 1e-4 * depth_range.y;
    if (line_branch(segment + 1) != branch_id || behind) gl_Position = kOutside;
}
