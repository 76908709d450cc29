// Functions that GLSL 3.30 lacks, as defined by 4.50 (section 8.4).
uint packSnorm2x16(vec2 v) {
    ivec2 words = ivec2(round(clamp(v, -1.0, 1.0) * 32767.0));
    return (uint(words.x) & 0xffffu) | (uint(words.y) << 16);
}

vec2 unpackSnorm2x16(uint bits) {
    ivec2 words = ivec2(int(bits << 16) >> 16, int(bits) >> 16);
    return clamp(vec2(words) / 32767.0, -1.0, 1.0);
}
