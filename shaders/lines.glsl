// Points of centerlines. The points of a branch are consecutive: each but the last starts a segment that ends at the
// next.
layout(binding = kUnitLinePoints) uniform samplerBuffer line_points;    // position, mm from the root
layout(binding = kUnitLineDetails) uniform usamplerBuffer line_details; // bits of the diameter, branch

vec3 line_point(int i) { return texelFetch(line_points, i).xyz; }
float line_diameter(int i) { return uintBitsToFloat(texelFetch(line_details, i).x); }
int line_branch(int i) { return int(texelFetch(line_details, i).y); }
