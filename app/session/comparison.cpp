#include "app/session/comparison.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace ramus::app {

namespace {

std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        parts.push_back(text.substr(from, comma - from));
        from = comma + 1;
    }
    return parts;
}

} // namespace

std::string_view name_of(SurfaceKind kind) {
    return kind == SurfaceKind::kConvolution ? "cs" : kind == SurfaceKind::kCones ? "cones" : "iso";
}

std::optional<SurfaceKind> surface_kind_named(std::string_view name) {
    const auto found = std::ranges::find_if(kSurfaceKinds, [&](SurfaceKind kind) { return name_of(kind) == name; });
    return found == kSurfaceKinds.end() ? std::nullopt : std::optional(*found);
}

SurfaceKind kind_of(mesh::Method method) {
    return method == mesh::Method::kTruncatedCones ? SurfaceKind::kCones : SurfaceKind::kConvolution;
}

std::string_view name_of(Comparison::Mode mode) {
    switch (mode) {
    case Comparison::Mode::kSideBySide:
        return "side-by-side";
    case Comparison::Mode::kBlend:
        return "blend";
    case Comparison::Mode::kSuperimposed:
        return "superimposed";
    default:
        return "off";
    }
}

std::optional<Comparison::Mode> comparison_mode_named(std::string_view name) {
    const auto found =
        std::ranges::find_if(kComparisonModes, [&](Comparison::Mode mode) { return name_of(mode) == name; });
    return found == kComparisonModes.end() ? std::nullopt : std::optional(*found);
}

std::vector<SurfaceKind> compared_surfaces(const Comparison& comparison) {
    if (comparison.mode == Comparison::Mode::kOff) return {};
    std::vector<SurfaceKind> surfaces = comparison.surfaces;
    if (comparison.mode != Comparison::Mode::kSideBySide) surfaces.resize(2);
    return surfaces;
}

std::string title_of(SurfaceKind kind, const Comparison& comparison) {
    if (kind == SurfaceKind::kConvolution) return "Convolution surface";
    if (kind == SurfaceKind::kCones) return "Truncated cones";
    if (comparison.mask.empty()) return "Isosurface of the tree's voxels";
    std::string title = "Isosurface of " + std::filesystem::path(comparison.mask).filename().string();
    for (std::size_t i = 0; i < comparison.labels.size(); ++i)
        title += (i > 0                          ? ", "
                  : comparison.labels.size() > 1 ? ", labels "
                                                 : ", label ") +
                 std::to_string(comparison.labels[i]);
    return title;
}

std::optional<std::vector<SurfaceKind>> surface_list(std::string_view text) {
    std::vector<SurfaceKind> kinds;
    for (const std::string_view part : parts_of(text)) {
        const auto kind = surface_kind_named(part);
        if (!kind || std::ranges::find(kinds, *kind) != kinds.end()) return std::nullopt;
        kinds.push_back(*kind);
    }
    if (kinds.size() < 2) return std::nullopt;
    return kinds;
}

std::optional<std::vector<std::int32_t>> label_list(std::string_view text) {
    std::vector<std::int32_t> labels;
    for (const std::string_view part : parts_of(text)) {
        std::int32_t label = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), label);
        if (error != std::errc() || end != part.data() + part.size() || label == 0) return std::nullopt;
        labels.push_back(label);
    }
    std::ranges::sort(labels);
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    return labels;
}

} // namespace ramus::app
