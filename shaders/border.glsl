// Which branch a point of a triangle belongs to where branches meet (border.geom).
in vec3 shares;
flat in ivec3 branch_ids;
layout(binding = kUnitLayers) uniform usamplerBuffer layers; // by branch: 0 opaque, 1 glass, 2 neither

// The corner whose branch has the largest share; in a tie the first.
int owner(vec3 share) {
    return share.x >= share.y && share.x >= share.z ? 0 : share.y >= share.z ? 1 : 2;
}

uint layer_of(int branch) { return texelFetch(layers, branch).x; }

#ifdef FALLBACK
// GLSL 3.30 cannot interpolate at samples. Returns the shares at an offset in pixels, up to a positive factor: divided
// by w, they are linear in the picture.
vec3 shares_at(vec2 pixels) {
    vec3 over_w = shares * gl_FragCoord.w;
    return over_w + pixels.x * dFdx(over_w) + pixels.y * dFdy(over_w);
}
#endif
