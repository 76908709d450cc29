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

std::vector<mesh::Method> compared_surfaces(const Comparison& comparison) {
    if (comparison.mode == Comparison::Mode::kOff) return {};
    std::vector<mesh::Method> surfaces = comparison.surfaces;
    if (comparison.mode != Comparison::Mode::kSideBySide) surfaces.resize(2);
    return surfaces;
}

std::string title_of(mesh::Method method, const Comparison& comparison) {
    std::string title(mesh::row_of(method).label);
    if (mesh::row_of(method).of_tree) return title;
    if (comparison.mask.empty()) return title + " of the tree's voxels";
    title += " of " + std::filesystem::path(comparison.mask).filename().string();
    for (std::size_t i = 0; i < comparison.labels.size(); ++i)
        title += (i > 0                          ? ", "
                  : comparison.labels.size() > 1 ? ", labels "
                                                 : ", label ") +
                 std::to_string(comparison.labels[i]);
    return title;
}

std::optional<std::vector<mesh::Method>> surface_list(std::string_view text) {
    std::vector<mesh::Method> methods;
    for (const std::string_view part : parts_of(text)) {
        const auto method = mesh::method_named(part);
        if (!method || std::ranges::find(methods, *method) != methods.end()) return std::nullopt;
        methods.push_back(*method);
    }
    if (methods.size() < 2) return std::nullopt;
    return methods;
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

std::optional<std::vector<std::vector<std::int32_t>>> label_groups(std::string_view text) {
    std::vector<std::vector<std::int32_t>> groups;
    for (const std::string_view part : parts_of(text)) {
        std::string list(part);
        std::ranges::replace(list, '+', ',');
        auto labels = label_list(list);
        if (!labels) return std::nullopt;
        groups.push_back(std::move(*labels));
    }
    return groups;
}

} // namespace ramus::app
