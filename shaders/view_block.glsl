// Members of the uniform block View; C++ includes this file by render/scene/uniform_blocks.h.
vec4 clip_to_eye;  // depth buffer to depth: perspective z / (w + y), orthographic (value - z) * y
vec4 pixel_to_eye; // eye xy = (pixel - xy) * z (times depth in perspective)
vec4 depth_range;  // near and far end of the tree in mm along the line of sight, occlusion radius in pixels, in mm
vec4 picture;      // width, height, samples, 1 when orthographic
