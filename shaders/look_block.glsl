// Members of the uniform block Look; C++ includes this file by render/scene/uniform_blocks.h.
vec4 background_top;    // sRGB; w: 1 when transparent
vec4 background_bottom; // sRGB; w: depth cue
vec4 glass_colour;      // linear; w: 1 when there is any glass
vec4 selection_colour;  // linear; w: outline's radius in pixels, 0 for none
vec4 lights;            // key, fill, rim, specular
vec4 more;              // occlusion strength, glass opacity, pixels per point, strength of shadows
vec4 line_colour;       // linear
vec4 lost_colour;       // linear
vec4 far_colour;        // linear: colour into which the far end of the tree fades
vec4 cues;              // strength of halos, contours, chromadepth; radius of halos in pixels
