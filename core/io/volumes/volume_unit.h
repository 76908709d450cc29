// The unit of a volume's lengths: what its file states, what a person says, and a word where its size looks like
// another.
#pragma once

#include "core/base/error.h"
#include "core/io/trees/imported_tree.h"
#include "core/volume/volume.h"

#include <optional>
#include <string>

namespace ramus::io {

// Puts a volume whose lengths count in the unit that its file states (mm where it states none) into the unit that a
// person asks for, along each of the patient's axes, as trees are. Adds what is assumed and suspected to its notes.
// Fails where voxels would then lie where no patient can be.
[[nodiscard]] Result<void> apply_unit(volume::Volume& volume, const std::optional<LengthUnit>& asked,
                                      const std::string& name);

// Of a tree that is made of the volume, read with the unit that a person asked for.
[[nodiscard]] tree::Claims claims_of(const volume::Volume& volume, const std::optional<LengthUnit>& asked);

} // namespace ramus::io
