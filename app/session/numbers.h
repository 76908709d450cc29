// Numbers as people read them, in the window and on the command line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ramus::app {

[[nodiscard]] std::string grouped(std::uint64_t number);             // "1,234,567"
[[nodiscard]] std::string exact_text(double value);                  // as few digits as read as the same number
[[nodiscard]] std::string rounded(double number);                    // "0.1235"
[[nodiscard]] std::string digits(double value, int significant = 3); // "0.031", "12.3", "1,234"
[[nodiscard]] std::string length_text(double mm);                    // "12.3 mm", "1.42 m"
[[nodiscard]] std::string volume_text(double mm3);                   // "12.3 mm³", "1.42 ml"
[[nodiscard]] std::string seconds_text(double seconds);              // "12 ms", "1.42 s"

// "1 branch", "1,504 branches".
[[nodiscard]] std::string counted(std::uint64_t number, const std::string& one, const std::string& many);

// From `low` to `high`, ascending: multiples of 1, 2 or 5 times a power of ten, ten at most. Logarithmic: 1, 2 and 5
// times every power of ten, both ends above 0.
[[nodiscard]] std::vector<double> round_numbers(double low, double high, bool logarithmic = false);

} // namespace ramus::app
