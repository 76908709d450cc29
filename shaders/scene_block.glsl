// Members of the uniform block Scene; C++ includes this file by render/scene/uniform_blocks.h.
mat4 eye_to_lines;          // eye space to the centerlines' own
mat4 eye_to_grid;           // eye space to the distance grid's texture coordinates
vec4 counts;                // numbers of spherical lesions, lost parts, margins; 1 with a grid
vec4 scale;                 // low, 1 / (high - low), 1 when logarithmic; 0: none, 1 for diameters, 2 for mm from the root,
                            // 3 for the surface's own values
vec4 margins[kMostMargins]; // linear colour, and outer distance in mm
