// Bits of ids and of branch records; C++ includes this file by render/scene/record_flags.h.

// An id is a branch's number + 1, or 0 for nothing. These bits mark other ids:
const uint kLine = 0x80000000u;    // the centerline of that branch
const uint kSolid = 0x40000000u;   // a lesion, by its number + 1: only in ids for picks
const uint kContext = 0x20000000u; // with kSolid: a context mesh instead of a lesion
const uint kCap = 0x10000000u;     // in samples: seen into a cut, see caps.glsl

// In ids of glass fragments, which have fewer bits (glass_fragments.glsl): a lesion instead of a context mesh.
const uint kLesionFragment = 0x00400000u;
const uint kNumberBits = 0x003fffffu; // number + 1 of a context mesh or lesion

// Flags of a branch's record.
const uint kCalm = 1u; // others are highlighted
const uint kHighlighted = 2u;
const uint kHovered = 4u;
const uint kSelected = 8u;
const uint kLost = 16u;
const uint kCut = 32u;     // lost in part
const uint kGlowing = 64u; // depends on the hovered branch
const uint kChanged = 128u; // changed since the last picture
