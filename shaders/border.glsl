// Which branch a point of a triangle belongs to where branches meet (border.geom).
in vec3 shares;
flat in ivec3 branch_ids;
layout(binding = kUnitLayers) uniform usamplerBuffer layers; // by branch: 0 opaque, 1 glass, 2 neither

// The corner whose branch has most; of those that have the same, the first.
int owner(vec3 share) {
    return share.x >= share.y && share.x >= share.z ? 0 : share.y >= share.z ? 1 : 2;
}

uint layer_of(int branch) { return texelFetch(layers, branch).x; }

#ifdef FLOOR
// GLSL 3.30 does not read values at samples. The shares so far from the pixel's middle, times something above 0: over w,
// they are linear in the picture.
vec3 shares_at(vec2 pixels) {
    vec3 over_w = shares * gl_FragCoord.w;
    return over_w + pixels.x * dFdx(over_w) + pixels.y * dFdy(over_w);
}
#endif
