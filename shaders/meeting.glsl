// Where glass meets what is opaque: which of the branches that meet there a place belongs to, by how near it is to
// their centerlines, measured in their radii. That is smooth, where the branches of vertices are steps.
layout(binding = 0) uniform samplerBuffer line_points;      // position
layout(binding = 1) uniform usamplerBuffer line_details;    // bits of the diameter, branch
layout(binding = 2) uniform usamplerBuffer line_runs;       // first point, count
layout(binding = 3) uniform usamplerBuffer meetings;        // by branch: first, count in `meeting_branches`
layout(binding = 4) uniform usamplerBuffer meeting_branches; // branch, not 0 for glass
layout(location = 3) uniform vec3 lines_to_mesh;            // the lines' positions + this are the mesh's

// Square of the distance to the branch's centerline in radii. Long runs are looked at in some 24 steps.
float nearness(int branch, vec3 p) {
    uvec2 run = texelFetch(line_runs, branch).xy;
    int first = int(run.x), last = first + int(run.y) - 1, stride = max(1, (int(run.y) + 22) / 24);
    float nearest = 1e6;
    vec3 a = texelFetch(line_points, first).xyz;
    float ra = 0.5 * uintBitsToFloat(texelFetch(line_details, first).x);
    for (int i = first; i < last; i += stride) {
        int next = min(i + stride, last);
        vec3 b = texelFetch(line_points, next).xyz, ab = b - a, ap = p - a;
        float rb = 0.5 * uintBitsToFloat(texelFetch(line_details, next).x);
        float t = clamp(dot(ap, ab) / max(dot(ab, ab), 1e-12), 0.0, 1.0), r = mix(ra, rb, t);
        vec3 away = ap - t * ab;
        nearest = min(nearest, dot(away, away) / max(r * r, 1e-12));
        a = b;
        ra = rb;
    }
    return nearest;
}

// Above 0: belongs to the glass.
float glassiness(int branch, vec3 position) {
    vec3 p = position - lines_to_mesh;
    uvec2 meeting = texelFetch(meetings, branch).xy;
    float opaque = 1e6, glass = 1e6;
    for (uint i = 0u; i < meeting.y; ++i) {
        uvec2 one = texelFetch(meeting_branches, int(meeting.x + i)).xy;
        float here = nearness(int(one.x), p);
        opaque = one.y == 0u ? min(opaque, here) : opaque;
        glass = one.y != 0u ? min(glass, here) : glass;
    }
    return clamp(opaque - glass, -4.0, 4.0);
}
