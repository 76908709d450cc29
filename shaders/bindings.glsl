// Numbers of texture units, blocks, uniforms, vertex attributes and render targets: the only place that defines them.
// C++ includes this file by render/gl/bindings.h. A unit or uniform has the same meaning in all programs.
// shader_text.cpp replaces these names in layout(...) by their numbers.

// Texture units. OpenGL 3.3 guarantees 48, and 16 per stage.
const int kUnitSurface = 0;         // multisampled: id and normal of the nearest opaque surface, or of a layer of glass
const int kUnitDepth = 1;           // multisampled: its depth
const int kUnitOpaqueDepth = 2;     // per pixel: mm along the line of sight
const int kUnitShapes = 3;          // of context meshes and lesions: colour, opacity
const int kUnitIdNormal = 4;        // a pixel
const int kUnitOcclusion = 5;       // a pixel
const int kUnitBranches = 6;        // of branches: colour, flags
const int kUnitLinePoints = 7;      // of centerlines
const int kUnitLineDetails = 8;     // of their points: diameter, branch
const int kUnitLineRuns = 9;        // of branches: which points
const int kUnitLesions = 10;        // spheres
const int kUnitCuts = 11;           // parts of branches that are lost
const int kUnitRamp = 12;           // colours of a scale
const int kUnitDistances = 13;      // to lesions, in space
const int kUnitFronts = 14;         // glass in front of each sample
const int kUnitOpaqueSamples = 15;  // multisampled: depth of the nearest opaque surface
const int kUnitLayers = 16;         // of branches: opaque, glass or neither
const int kUnitLastLayer = 17;      // multisampled: depth of the previous layer of glass
const int kUnitFirstFragments = 18; // multisampled: nearest layer of glass
const int kUnitFirstDepths = 19;    // multisampled: its depth
const int kUnitContextDepths = 20;  // multisampled: depth of the nearest transparent shape
const int kUnitImage = 21;          // input of a full-screen pass
const int kUnitOtherImage = 22;     // second input, to mix with
const int kUnitRings = 23;          // of the skeleton: centre, radius, axis
const int kUnitSeenRings = 24;      // which of them
const int kUnitValues = 25;         // multisampled: of the nearest opaque surface, where it has any
const int kUnitPlanes = 26;         // pictures of slices, a layer each: premultiplied sRGB
const int kUnitSliceGuide = 27;     // a pixel: output of slice_guide.frag
const int kUnits = 28;

// Uniform blocks.
const int kBlockView = 0;
const int kBlockLook = 1;
const int kBlockScene = 2;
const int kBlockPlanes = 3;

// Storage blocks: the lists of glass.
const int kStorageHeads = 0;
const int kStorageFragments = 1;
const int kStorageCount = 2;

// Uniforms. gl_fallback keeps a table of kUniforms entries per program.
const int kUniformToClip = 0;          // mat4
const int kUniformToEye = 1;           // mat3, rotation only
const int kUniformSamples = 2;         // int: of a pixel
const int kUniformLayer = 3;           // int: of glass
const int kUniformBand = 4;            // ivec2: width and first row of the band that the lists are for
const int kUniformCapacity = 5;        // uint: of the lists, fragments
const int kUniformSamplePosition = 6;  // vec2: from the pixel's middle, pixels
const int kUniformNumber = 7;          // uint: of a context mesh or lesion
const int kUniformSamplePositions = 8; // vec2[4]: takes four
const int kUniformHalfWidth = 12;      // float: of a line, pixels
const int kUniformHalfPicture = 13;    // vec3: half the size in pixels, half the width of a line
const int kUniformLinesToEye = 14;     // mat4
const int kUniformZoom = 15;           // vec2: eye xy (at depth 1 when perspective) to clip space
const int kUniformToDepth = 16;        // vec4: from mm to mm along the line of sight
const int kUniformTint = 17;           // vec4: sRGB; opacity inside its vessel
const int kUniformRingSteps = 18;      // vec2: corners of a ring; pixels below which it fades
const int kUniformToInner = 19;        // vec2: pixels of the picture to those of what was drawn
const int kUniformSize = 20;           // vec2: of the picture, pixels
const int kUniformShare = 21;          // float: of one image in a mean
const int kUniformTaps = 22;           // int: of the occlusion
const int kUniformTurned = 23;         // float: all of them, of a sixteenth of the way around
const int kUniformAlong = 24;          // ivec2: axis of the blur
const int kUniformOrigin = 25;         // ivec2: lower left corner, pixels
const int kUniformWindow = 26;         // vec4: of the interface: x, y, width, height
const int kUniformLine = 27;           // vec3: pixels from the left, half width, height; negative position: no line
const int kUniformInside = 28;         // int: 1 where the eye is inside a vessel
const int kUniformCut = 29;            // vec4: plane that cuts off what is below 0, in the positions' space
const int kUniformCap = 30;            // vec4: its normal towards the eye, in eye space; 1 where caps are seen
const int kUniformCapValues = 31;      // vec4: value in the depth buffer, of (x, y, 1) of a pixel; added for its samples
const int kUniforms = 32;

// Vertex attributes: of meshes, of marks, of the interface.
const int kAttributePosition = 0;
const int kAttributeNormal = 1;
const int kAttributeBranch = 2;
const int kAttributeDominance = 3;
const int kAttributeValue = 4;
const int kAttributePixel = 0;
const int kAttributeStripe = 1;
const int kAttributeInk = 2;
const int kAttributeUv = 1;
const int kAttributeColour = 2;

// Targets of geometry.frag.
const int kTargetSurface = 0;
const int kTargetValue = 1;

// Targets of slices.frag and slice_pixel.glsl.
const int kTargetColour = 0;
const int kTargetSeenDepth = 1;

// Targets of resolve.frag.
const int kTargetIdNormal = 0;
const int kTargetOpaqueDepth = 1;
const int kTargetPickedDepth = 2;
