// Colours and lights of the frame, and the conversion from linear light to the picture's bytes.
layout(std140, binding = kBlockLook) uniform Look {
#include "look_block.glsl"
};
#include "look/srgb.glsl"
#include "look/colour.glsl"
