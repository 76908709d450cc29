// Colours as DICOM writes them (PS3.3, C.10.7.1.1): CIE L*a*b* of the profile connection space, whose white is D50.
#pragma once

#include <array>
#include <cstdint>

namespace ramus::io {

// L*, a* and b* as numbers of 16 bits: L* from 0 to 100, a* and b* from -128 to 127. Colours that sRGB lacks are moved
// to its border, each component by itself.
[[nodiscard]] std::array<std::uint8_t, 3> srgb_of_dicom_lab(const std::array<int, 3>& lab);

} // namespace ramus::io
