// Converts colours from DICOM's encoding (PS3.3, C.10.7.1.1: CIE L*a*b* with white point D50) to sRGB.
#pragma once

#include <array>
#include <cstdint>

namespace ramus::io {

// `lab`: 16-bit numbers for L* from 0 to 100, a* and b* from -128 to 127. Clamps each component to sRGB.
[[nodiscard]] std::array<std::uint8_t, 3> srgb_of_dicom_lab(const std::array<int, 3>& lab);

} // namespace ramus::io
