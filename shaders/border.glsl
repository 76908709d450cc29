// Which branch a point of a triangle belongs to where branches meet (border.geom).
#include "bindings.glsl"
in vec3 shares;
flat in ivec3 branch_ids;
layout(binding = kUnitLayers) uniform usamplerBuffer layers; // by branch: 0 opaque, 1 glass, 2 neither

// The corner whose branch has most; of those that have the same, the first.
int owner(vec3 share) {
    return share.x >= share.y && share.x >= share.z ? 0 : share.y >= share.z ? 1 : 2;
}

uint layer_of(int branch) { return texelFetch(layers, branch).x; }
