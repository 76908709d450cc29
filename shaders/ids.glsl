// What ids and branches' records say; C++ reads these by render/scene/record_flags.h.

// An id is a branch's number + 1, and 0 where nothing is. With one of these bits it is something else:
const uint kLine = 0x80000000u;    // the centerline of that branch
const uint kSolid = 0x40000000u;   // a lesion, by its number + 1: only in what is picked
const uint kContext = 0x20000000u; // with kSolid: a context mesh instead of a lesion

// A glass fragment's id, which has fewer bits (glass_fragments.glsl): a context mesh's or, with this, a lesion's.
const uint kLesionFragment = 0x00400000u;
const uint kNumberBits = 0x003fffffu; // number + 1 of a context mesh or lesion

// A branch's record: how it is seen.
const uint kCalm = 1u; // others are highlighted
const uint kHighlighted = 2u;
const uint kHovered = 4u;
const uint kSelected = 8u;
const uint kLost = 16u;
const uint kCut = 32u;     // lost in part
const uint kGlowing = 64u; // depends on what is hovered
const uint kChanged = 128u; // since the last picture
