#include "core/io/volumes/slicer_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace ramus::io {

namespace {

constexpr std::int32_t kMostUnnamed = 1024;

std::optional<std::array<std::uint8_t, 3>> slicer_colour(const std::string& text) {
    const auto numbers = numbers_in(text);
    if (!numbers || numbers->size() < 3) return std::nullopt;
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double part = (*numbers)[i];
        if (!(part >= 0.0 && part <= 1.0)) return std::nullopt;
        colour[i] = static_cast<std::uint8_t>(std::lround(255.0 * part));
    }
    return colour;
}

// Whether the values of the segments can be their labels: all different and small.
bool are_labels(const std::vector<SlicerSegment>& segments) {
    constexpr std::int32_t kMostLabel = 60000; // so that also values without a segment and overlaps stay below 2^16
    std::set<std::int32_t> values;
    return std::ranges::all_of(segments, [&](const SlicerSegment& segment) {
        return segment.value <= kMostLabel && values.insert(segment.value).second;
    });
}

std::vector<volume::LabelName> named(const std::vector<SlicerSegment>& segments, bool by_value) {
    std::vector<volume::LabelName> names;
    for (std::size_t n = 0; n < segments.size(); ++n)
        names.push_back({.label = by_value ? segments[n].value : static_cast<std::int32_t>(n) + 1,
                         .name = segments[n].name,
                         .colour = segments[n].colour});
    std::ranges::stable_sort(names, {}, &volume::LabelName::label);
    return names;
}

std::int32_t last_label(const std::vector<volume::LabelName>& names) { return names.empty() ? 0 : names.back().label; }

} // namespace

std::vector<SlicerSegment> slicer_segments(const HeaderText& header) {
    std::vector<SlicerSegment> segments;
    for (std::size_t n = 0;; ++n) {
        const auto field = [&, of = ":segment" + std::to_string(n) + "_"](const char* what) {
            const auto found = header.fields.find(of + what);
            return found == header.fields.end() ? nullptr : &found->second;
        };
        const auto whole = [&](const char* what, std::int64_t otherwise) {
            const std::string* text = field(what);
            const auto numbers = text == nullptr ? std::nullopt : whole_numbers_in(*text);
            return numbers && numbers->size() == 1 ? numbers->front() : otherwise;
        };
        const std::string* name = field("name");
        if (name == nullptr) name = field("id");
        if (name == nullptr) break;
        const std::int64_t value = whole("labelvalue", static_cast<std::int64_t>(n) + 1);
        if (value < 1 || value > std::numeric_limits<std::int32_t>::max()) continue;
        const std::string* colour = field("color");
        segments.push_back({.name = *name,
                            .layer = whole("layer", 0),
                            .value = static_cast<std::int32_t>(value),
                            .colour = colour == nullptr ? std::nullopt : slicer_colour(*colour)});
    }
    return segments;
}

std::vector<volume::LabelName> names_of(const std::vector<SlicerSegment>& segments) { return named(segments, true); }

SegmentLayers::SegmentLayers(std::size_t count, const std::vector<SlicerSegment>& segments,
                             std::vector<std::string>& notes)
    : count_(count), names_(named(segments, are_labels(segments))), next_(last_label(names_) + 1),
      end_(next_ + kMostUnnamed), overlaps_(end_), last_(count, 0) {
    const bool by_value = are_labels(segments);
    for (std::size_t n = 0; n < segments.size(); ++n)
        labels_.emplace(std::pair(segments[n].layer, std::int64_t{segments[n].value}),
                        by_value ? segments[n].value : static_cast<std::int32_t>(n) + 1);
    if (!by_value)
        notes.emplace_back("segments of different layers have the same label value: they are numbered in the order of "
                           "the file");
}

Result<std::int32_t> SegmentLayers::label_of(std::size_t layer, std::int64_t value) {
    if (value < 0) return fail("a layer of its segmentation has negative numbers", {}, "write the file again");
    const auto [place, is_new] = labels_.emplace(std::pair(static_cast<std::int64_t>(layer), value), next_);
    if (!is_new) return place->second;
    if (next_ == end_)
        return fail("its layers have more than " + std::to_string(kMostUnnamed) + " values that no segment has", {},
                    "write the file again, with a Segment_LabelValue for each segment");
    return next_++;
}

Result<std::int32_t> SegmentLayers::value_of(const std::int64_t* numbers) {
    std::int32_t value = 0;
    for (std::size_t layer = 0; layer < count_; ++layer) {
        if (numbers[layer] == 0) continue;
        RAMUS_TRY(label, label_of(layer, numbers[layer]));
        RAMUS_TRY(both, overlaps_.with(value, label));
        value = both;
    }
    return value;
}

Result<std::vector<std::int32_t>> SegmentLayers::merged(const std::vector<std::int64_t>& numbers,
                                                        const std::string& name) {
    std::vector<std::int32_t> values;
    values.reserve((begun_.size() + numbers.size()) / count_);
    const auto add = [&](const std::int64_t* voxel) -> Result<void> {
        if (!std::equal(last_.begin(), last_.end(), voxel)) {
            auto value = value_of(voxel);
            if (!value) return fail(value.error().what, name, value.error().hint);
            last_.assign(voxel, voxel + count_);
            last_value_ = *value;
        }
        values.push_back(last_value_);
        return {};
    };
    std::size_t used = 0;
    if (!begun_.empty()) {
        used = std::min(count_ - begun_.size(), numbers.size());
        begun_.insert(begun_.end(), numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(used));
        if (begun_.size() < count_) return values;
        if (auto added = add(begun_.data()); !added) return tl::unexpected(added.error());
    }
    for (; numbers.size() - used >= count_; used += count_)
        if (auto added = add(numbers.data() + used); !added) return tl::unexpected(added.error());
    begun_.assign(numbers.begin() + static_cast<std::ptrdiff_t>(used), numbers.end());
    return values;
}

void SegmentLayers::finish(volume::Volume& volume) && { std::move(overlaps_).finish(volume); }

} // namespace ramus::io
