#include "app/session/along_vessel.h"

#include "app/session/numbers.h"
#include "core/base/words.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace ramus::app {

namespace {

measure::BranchPlace place_at(const WayEnd& end, double usual) { return {end.branch, end.fraction.value_or(usual)}; }

std::string place_text(const measure::BranchPlace& place) {
    return std::to_string(place.branch) + "@" + in_digits(place.fraction);
}

} // namespace

std::optional<WayEnd> way_end_in(std::string_view word) {
    if (word == "root") return WayEnd{};
    const std::size_t at = word.find('@');
    const auto branch = parsed<int>(word.substr(0, at));
    if (!branch || *branch < 0) return {};
    if (at == std::string_view::npos) return WayEnd{*branch};
    const auto fraction = parsed<double>(word.substr(at + 1));
    if (!fraction || !(*fraction >= 0.0 && *fraction <= 1.0)) return {};
    return WayEnd{*branch, fraction};
}

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

std::string text_of(const Way& way) {
    const auto end_text = [](const WayEnd& end) {
        if (end.branch < 0) return std::string("root");
        return std::to_string(end.branch) + (end.fraction ? "@" + exact_text(*end.fraction) : "");
    };
    return end_text(way.from) + (way.to ? ".." + end_text(*way.to) : "");
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
        return fail("the place " + place_text(place) + " is not on the path", {}, "choose a place between its ends");
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

slice::SampleRange samples_of(const slice::VesselPath& path, const Stretch& stretch) {
    const auto [first, last] = std::minmax(stretch.from_mm, stretch.to_mm);
    return {path.nearest(first), path.nearest(last)};
}

} // namespace ramus::app
