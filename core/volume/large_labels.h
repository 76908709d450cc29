// LargeLabels: labels that 32 bits do not hold, as the 18 digits of neurons, become small numbers, in the order in
// which they come; their names are the file's numbers. Labels that are small stay what they are.
#pragma once

#include "core/volume/volume.h"

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace ramus::volume {

class LargeLabels {
public:
    // More different labels are those of no mask.
    static constexpr std::size_t kMost = 65'535;

    // The small number of a label; none: there are more than kMost, or a small label has the number of a large one.
    [[nodiscard]] std::optional<std::int32_t> number_of(std::int64_t label);
    [[nodiscard]] std::optional<std::int32_t> number_of(std::uint64_t label);
    [[nodiscard]] std::size_t count() const { return names_.size(); }
    // Ascending by number.
    [[nodiscard]] std::vector<LabelName> names() &&;

private:
    [[nodiscard]] std::optional<std::int32_t> small(std::int32_t label);
    [[nodiscard]] std::optional<std::int32_t> large(std::uint64_t bits, std::string name);

    std::unordered_set<std::int32_t> small_;                  // that came, kMost + 1 at the most
    std::unordered_map<std::uint64_t, std::int32_t> numbers_; // by the bits of the label
    std::vector<LabelName> names_;
    std::int32_t last_ = 0; // number that was given
};

} // namespace ramus::volume
