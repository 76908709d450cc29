// Sizes that shaders and C++ agree on (render/scene/uniform_blocks.h).
const int kMostSamples = 4;  // a pixel
const int kMostMargins = 16; // bands around lesions
const float kNotKnown = -1e30F;    // in place of a value on a scale
const float kLeastKnown = -1e15F; // below: mixed with one that is not known, if only a little
