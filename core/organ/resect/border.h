// Resections along the border of a territory.
#pragma once

#include "core/base/error.h"
#include "core/organ/organ.h"
#include "core/organ/resect/sheet.h"

#include <cstdint>
#include <span>

namespace ramus::organ {

// The sheet through the middles of the faces between a part and the others, smoothed as sheet_through() does; removed
// is the side that has more of the part. Its base plane fits these middles best. `part_of`: by voxel of the organ: its
// part, 0: none. Fails if the part touches no other, or in a line only.
[[nodiscard]] Result<Sheet> sheet_along_border(const Organ& organ, std::span<const std::uint16_t> part_of,
                                               std::uint16_t part);

} // namespace ramus::organ
