// What is seen at a sample: branch id + 1 (0 is nothing) and the normal towards the eye. Light comes later, once a pixel.
#version 450 core

in vec3 normal_eye;
flat in int branch_id;

layout(location = 0) out uvec2 surface;

vec2 octahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return n.z < 0.0 ? folded : p;
}

void main() {
    surface = uvec2(uint(branch_id + 1), packSnorm2x16(octahedral(normalize(normal_eye))));
}
