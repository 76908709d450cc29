// LargeLabels: maps labels of more than 32 bits, such as ids of neurons with 18 digits, to small numbers, in the order
// of their first occurrence. Their names are the original numbers. Small labels stay as they are.
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
    // A volume with more different labels is no mask.
    static constexpr std::size_t kMost = 65'535;

    // The small number of a label. None: there are more than kMost labels, or a small label equals the number given to
    // a large one.
    [[nodiscard]] std::optional<std::int32_t> number_of(std::int64_t label);
    [[nodiscard]] std::optional<std::int32_t> number_of(std::uint64_t label);
    [[nodiscard]] std::size_t count() const { return names_.size(); }
    // The original numbers of large labels as names, ascending by small number.
    [[nodiscard]] std::vector<LabelName> names() &&;

private:
    [[nodiscard]] std::optional<std::int32_t> small(std::int32_t label);
    [[nodiscard]] std::optional<std::int32_t> large(std::uint64_t bits, std::string name);

    std::unordered_set<std::int32_t> small_;                  // seen so far, at most kMost + 1
    std::unordered_map<std::uint64_t, std::int32_t> numbers_; // by the bits of the label
    std::vector<LabelName> names_;
    std::int32_t last_ = 0; // last number given to a large label
};

} // namespace ramus::volume
