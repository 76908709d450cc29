// Formats numbers for people, in the window and on the command line.
#pragma once

#include "core/measure/amount.h"
#include "core/tree/vessel_tree.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

[[nodiscard]] std::string grouped(std::uint64_t number);             // "1,234,567"
[[nodiscard]] std::string exact_text(double value);                  // the fewest digits that parse as the same number
[[nodiscard]] std::string rounded(double number);                    // "0.1235"
[[nodiscard]] std::string digits(double value, int significant = 3); // "0.031", "12.3", "1,234"
[[nodiscard]] std::string seconds_text(double seconds);              // "12 ms", "1.42 s"

// Formats lengths of a tree; the only place that appends a unit to a number. If the unit is unknown, lengths are never
// called mm: "12.3 units".
class Lengths {
public:
    Lengths() = default; // the unit is mm
    explicit Lengths(const tree::Claims& claims) : claims_(claims) {}
    [[nodiscard]] bool known() const { return claims_.has_unit(); }
    [[nodiscard]] std::string unit() const { return worded("mm"); }
    // "12.3 mm", "1.42 m"; "1,420 units".
    [[nodiscard]] std::string text(double length, int significant = 3) const;
    [[nodiscard]] std::string area(double area) const;                // "12.3 mm²", "1,420 units²"
    [[nodiscard]] std::string volume(double volume) const;            // "12.3 mm³", "1.42 ml"; "1,420 units³"
    [[nodiscard]] std::string range(double least, double most) const; // "1.4 – 12.3 mm"
    // Replaces mm in a text if the unit is unknown: "Ø mm", "Margins 5, 10, 20 mm".
    [[nodiscard]] std::string worded(std::string_view text) const { return claims_.worded(text); }
    // The unit in tables and JSON: "mm" or "unknown".
    [[nodiscard]] std::string word() const { return std::string(claims_.unit_word()); }

private:
    tree::Claims claims_;
};

// "2026-11-28 17:04", in the machine's time zone.
[[nodiscard]] std::string local_time_text(std::chrono::system_clock::time_point time);

// "1 branch", "1,504 branches".
[[nodiscard]] std::string counted(std::uint64_t number, const std::string& one, const std::string& many);

// "3 branches, 16.0 mm, 1.55 ml of vessel volume, 2 leaves".
[[nodiscard]] std::string amount_text(const measure::Amount& amount, const Lengths& lengths);

// "over 5.00 mm": for a cut through a vessel that is larger than the limit.
[[nodiscard]] std::string over_text(double limit_mm, const Lengths& lengths);

// Round numbers between `low` and `high`, ascending: at most ten multiples of 1, 2 or 5 times a power of ten.
// Logarithmic: 1, 2 and 5 times every power of ten; both ends must be positive.
[[nodiscard]] std::vector<double> round_numbers(double low, double high, bool logarithmic = false);

} // namespace ramus::app
