#include "app/commands/reformat_sections.h"

#include "app/commands/organ_case.h"
#include "core/base/words.h"
#include "core/slice/mask_loops.h"

#include <algorithm>

namespace ramus::app {

namespace {

std::optional<WayEnd> way_end_in(std::string_view word) {
    if (word == "root") return WayEnd{};
    const auto place = cut_in(word);
    if (!place) return {};
    const bool has_fraction = word.find('@') != std::string_view::npos;
    return WayEnd{place->first, has_fraction ? std::optional(place->second) : std::nullopt};
}

measure::BranchPlace place_at(const WayEnd& end, double usual) { return {end.branch, end.fraction.value_or(usual)}; }

std::string place_text(const measure::BranchPlace& place) {
    return std::to_string(place.branch) + "@" + in_digits(place.fraction);
}

} // namespace

std::optional<Way> way_in(std::string_view text) {
    const std::size_t dots = text.find("..");
    const auto from = way_end_in(text.substr(0, dots));
    if (!from) return {};
    if (dots == std::string_view::npos)
        return from->branch < 0 || from->fraction ? std::nullopt : std::optional(Way{*from, {}});
    const auto to = way_end_in(text.substr(dots + 2));
    if (!to || to->branch < 0 || (from->branch < 0 && to->fraction)) return {};
    return Way{*from, *to};
}

Result<slice::VesselPath> path_along(const tree::VesselTree& tree, const Way& way, double step_mm) {
    if (!way.to) return slice::path_of_branch(tree, way.from.branch, step_mm);
    if (way.from.branch < 0) return slice::path_from_root(tree, way.to->branch, step_mm);
    return slice::path_between(tree, place_at(way.from, 0.0), place_at(*way.to, 1.0), step_mm);
}

std::optional<Reference> reference_in(std::string_view text) {
    if (const auto diameter = parsed<double>(text))
        return *diameter > 0.0 && *diameter < 1e9 ? std::optional(Reference{diameter, {}}) : std::nullopt;
    if (const auto place = way_end_in(text); place && place->branch >= 0) return Reference{{}, {*place, {}}};
    const auto way = way_in(text);
    if (!way || way->from.branch < 0) return {};
    return Reference{{}, *way};
}

Result<slice::SampleRange> samples_of(const slice::VesselPath& path, const Way& way) {
    const auto sample_at = [&](const measure::BranchPlace& place) -> Result<std::size_t> {
        if (const auto arc = path.arc_of(place)) return path.nearest(*arc);
        return fail("the place " + place_text(place) + " is not on the path", "--path",
                    "choose a place between its ends");
    };
    RAMUS_TRY(first, sample_at(place_at(way.from, 0.0)));
    if (!way.to) return slice::SampleRange{first, first};
    RAMUS_TRY(last, sample_at(place_at(*way.to, 1.0)));
    return slice::SampleRange{std::min(first, last), std::max(first, last)};
}

slice::SampleRange inner_samples(const tree::VesselTree& tree, const slice::VesselPath& path) {
    const auto is_free = [&](const measure::BranchPlace& place) {
        const tree::Branch& branch = tree.branches[static_cast<std::size_t>(place.branch)];
        const std::uint32_t node = place.fraction <= 0.0 ? branch.points.front() : branch.points.back();
        if (place.fraction > 0.0 && place.fraction < 1.0) return false;
        return std::ranges::count_if(tree.branches, [&](const tree::Branch& other) {
                   return other.points.front() == node || other.points.back() == node;
               }) == 1;
    };
    const slice::PathSample& start = path.samples.front();
    const slice::PathSample& end = path.samples.back();
    const double from = is_free(start.place) ? start.radius_mm : 0.0;
    const double to = path.length_mm() - (is_free(end.place) ? end.radius_mm : 0.0);
    if (from >= to) return {0, path.samples.size() - 1};
    return {path.nearest(from), path.nearest(to)};
}

std::vector<slice::SectionFigures> section_figures(const std::vector<std::optional<slice::Lumen>>& lumens) {
    std::vector<slice::SectionFigures> figures;
    for (const auto& lumen : lumens)
        figures.push_back(lumen && lumen->closed ? slice::SectionFigures(lumen->figures) : std::nullopt);
    return figures;
}

slice::LoopsOfPlane loops_of(const MaskVoxels& voxels, double half_mm) {
    return [&voxels, half_mm](const slice::Plane& plane) {
        return slice::mask_loops(voxels.inside, voxels.to_patient, plane, plane.point, half_mm);
    };
}

slice::LoopsOfPlane loops_of(const slice::MeshBlocks& blocks) {
    return [&blocks](const slice::Plane& plane) { return slice::section(blocks, plane); };
}

} // namespace ramus::app
