// Intersects the ray through a pixel with a round cone: the hull of balls whose centres and radii change linearly. A
// point x lies on the ball at s if |x - c(s)|^2 = r(s)^2; on the hull this has exactly one solution in s. With A = |x -
// a|^2 - ra^2, B = (x - a).(b - a) + ra (rb - ra), C = |b - a|^2 - (rb - ra)^2 the hull is A C = B^2, at s = B / C, a
// quadratic along the ray. Beyond the ends, the balls there count.
#include "view.glsl"

in vec2 through;
flat in vec3 from, to;
flat in vec2 radii;
flat in vec4 from_way, to_way;
flat in int branch_id;

layout(location = 0) out uvec2 surface;

float to_ball(vec3 off, vec3 ray, float radius) { // distance to the nearer intersection; 1e30: none
    float middle = dot(off, ray), inside = middle * middle - dot(off, off) + radius * radius;
    return inside > 0.0 ? -middle - sqrt(inside) : 1e30;
}

void main() {
    bool flat_view = picture.w > 0.5;
    vec3 eye = flat_view ? vec3(through, 0.0) : vec3(0.0);
    vec3 ray = flat_view ? vec3(0.0, 0.0, 1.0) : normalize(vec3(through, 1.0));
    // Starts at the point of the ray nearest to the cone, which keeps numbers small.
    float start = dot(0.5 * (from + to) - eye, ray);
    eye += start * ray;
    vec3 axis = to - from, off = eye - from;
    float growth = radii.y - radii.x;
    float c = dot(axis, axis) - growth * growth, slope = dot(ray, axis);
    float a0 = dot(off, off) - radii.x * radii.x, b0 = dot(off, axis) + radii.x * growth;
    float q2 = c - slope * slope, q1 = c * dot(off, ray) - b0 * slope, q0 = c * a0 - b0 * b0;
    float inside = q1 * q1 - q2 * q0;
    float way = (-q1 - sqrt(max(inside, 0.0))) / q2;
    float s = (b0 + way * slope) / c;
    bool side = inside > 0.0 && q2 > 0.0 && c > 0.0 && s >= 0.0 && s <= 1.0;
    float first = to_ball(off, ray, radii.x), last = to_ball(eye - to, ray, radii.y);
    float ball = min(first, last);
    way = side ? way : ball;
    if (way > 1e29) discard;
    s = side ? s : first <= last ? 0.0 : 1.0;
    vec3 hit = eye + way * ray;
    // Perpendicular to the vessel's interpolated direction instead of the segment's, so that joints are invisible.
    vec3 normal = hit - from - s * axis;
    vec4 here = mix(from_way, to_way, s);
    if (side || here.w > 0.5) normal -= dot(normal, here.xyz) * here.xyz;
    normal = normalize(normal) * vec3(1.0, 1.0, -1.0);
    surface = uvec2(uint(branch_id + 1), packSnorm2x16(octahedral(normal)));
    gl_FragDepth = flat_view ? hit.z / clip_to_eye.y + clip_to_eye.z : clip_to_eye.z / hit.z - clip_to_eye.y;
}
