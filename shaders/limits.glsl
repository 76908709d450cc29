// Sizes that shaders and C++ agree on (render/gl/bindings.h).
#ifndef LIMITS
#define LIMITS

const int kMostSamples = 4;  // a pixel
const int kMostMargins = 16; // bands around lesions

#endif
