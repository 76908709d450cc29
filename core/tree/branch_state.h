// BranchState: how a branch is shown, as a person chose it. Sessions store it; pictures, surfaces and the table of
// branches follow it.
#pragma once

#include <cstdint>

namespace ramus::tree {

enum class BranchState : std::uint8_t {
    kNormal,
    kHighlighted, // in the highlight colour; normal branches become calmer
    kDefocused,   // grey glass: what is behind it is visible and can be picked
    kHidden,      // not drawn, not picked
};

} // namespace ramus::tree
