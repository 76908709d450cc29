// Sizes that shaders and C++ agree on (render/scene/uniform_blocks.h).
const int kMostSamples = 4;  // per pixel
const int kMostMargins = 16; // bands around lesions
const int kMostPlanes = 8;   // slices of a scan
const int kPlaneRows = 16;   // of each plane, see planes_block.glsl
const float kNoSlice = -1e30F; // where a sample shows no slice
const float kNotKnown = -1e30F;    // marks a missing value on a scale
const float kLeastKnown = -1e15F; // smaller values result from interpolation with kNotKnown
