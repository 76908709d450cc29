// Settles the unit of length of a volume, from its file and the options of a person, and warns if its size suggests
// another unit.
#pragma once

#include "core/base/error.h"
#include "core/io/trees/imported_tree.h"
#include "core/volume/volume.h"

#include <optional>
#include <string>

namespace ramus::io {

// Converts a volume to mm with the unit `asked`, along each of the patient's axes. The volume must be in mm by the unit
// that its file states (mm if it states none). Without `asked` the volume stays as it is. Adds notes and suspicions.
// Fails if voxels would be where no patient can be.
[[nodiscard]] Result<void> apply_unit(volume::Volume& volume, const std::optional<LengthUnit>& asked,
                                      const std::string& name);

// The claims of a tree that is made from the volume, which was read with the unit `asked`.
[[nodiscard]] tree::Claims claims_of(const volume::Volume& volume, const std::optional<LengthUnit>& asked);

} // namespace ramus::io
