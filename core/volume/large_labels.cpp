#include "core/volume/large_labels.h"

#include <utility>

namespace ramus::volume {

std::optional<std::int32_t> LargeLabels::small(std::int32_t label) {
    // Labels come in runs of equal ones, and most volumes have few.
    if (label == 0 || small_.contains(label)) return label;
    if (label > 0 && label <= last_) return std::nullopt;
    if (small_.size() <= kMost) small_.insert(label);
    return label;
}

std::optional<std::int32_t> LargeLabels::large(std::uint64_t bits, std::string name) {
    if (const auto known = numbers_.find(bits); known != numbers_.end()) return known->second;
    if (names_.size() == kMost || small_.size() > kMost) return std::nullopt;
    do ++last_;
    while (small_.contains(last_));
    numbers_.emplace(bits, last_);
    names_.push_back({last_, std::move(name)});
    return last_;
}

std::optional<std::int32_t> LargeLabels::number_of(std::int64_t label) {
    return std::in_range<std::int32_t>(label) ? small(static_cast<std::int32_t>(label))
                                              : large(static_cast<std::uint64_t>(label), std::to_string(label));
}

std::optional<std::int32_t> LargeLabels::number_of(std::uint64_t label) {
    return std::in_range<std::int32_t>(label) ? small(static_cast<std::int32_t>(label))
                                              : large(label, std::to_string(label));
}

std::vector<LabelName> LargeLabels::names() && { return std::move(names_); }

} // namespace ramus::volume
