// What a sample's id says beside the branch: ids are a branch's + 1, 0 is nothing.
const uint kLine = 0x80000000u;  // the centerline of that branch
const uint kSolid = 0x40000000u; // a lesion, by its number + 1: only in what is picked
const uint kContext = 0x20000000u; // with kSolid: a context mesh instead of a lesion
