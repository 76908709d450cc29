// Sizes that shaders and C++ agree on (render/scene/uniform_blocks.h).
const int kMostSamples = 4;  // per pixel
const int kMostMargins = 16; // bands around lesions
const float kNotKnown = -1e30F;    // marks a missing value on a scale
const float kLeastKnown = -1e15F; // smaller values result from interpolation with kNotKnown
