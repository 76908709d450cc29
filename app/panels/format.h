// Numbers as people read them: three significant digits for lengths, groups of three for counts.
#pragma once

#include <cstdint>
#include <string>

namespace ramus::app {

[[nodiscard]] std::string digits(double value, int significant = 3); // "0.031", "12.3", "1,234"
[[nodiscard]] std::string count(std::uint64_t value);                // "1,234,567"
[[nodiscard]] std::string seconds_text(double seconds);              // "12 ms", "1.42 s"

} // namespace ramus::app
