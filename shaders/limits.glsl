// Sizes that shaders and C++ agree on (render/scene/uniform_blocks.h).
const int kMostSamples = 4;  // a pixel
const int kMostMargins = 16; // bands around lesions
