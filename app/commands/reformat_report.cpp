#include "app/commands/reformat_report.h"

#include "app/commands/listing.h"
#include "core/base/words.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

const slice::Lumen* lumen_in(const Lumens& lumens, std::size_t n) {
    return n < lumens.size() && lumens[n] ? &*lumens[n] : nullptr;
}

ordered_json figures_json(const slice::ShapeFigures& one) {
    return {{"area_mm2", one.area_mm2},
            {"equivalent_mm", one.equivalent_mm},
            {"least_mm", one.least_mm},
            {"largest_mm", one.largest_mm}};
}

ordered_json lumen_json(const slice::Lumen* lumen) {
    if (lumen == nullptr) return nullptr;
    ordered_json json = figures_json(lumen->figures);
    json["centroid"] = place_json(lumen->figures.centroid);
    json["closed"] = lumen->closed;
    json["shared_with"] = lumen->shared_with;
    return json;
}

ordered_json sample_json(const slice::PathSample& sample) {
    return {{"arc_mm", sample.arc_mm},
            {"branch", sample.place.branch},
            {"fraction", sample.place.fraction},
            {"at", place_json(sample.at)}};
}

ordered_json narrow_json(const std::optional<NarrowPlaces>& places, const slice::VesselPath& path) {
    if (!places) return nullptr;
    const auto one = [&](const slice::Narrowing& narrowing) {
        ordered_json json{{"percent", narrowing.percent}};
        json.update(sample_json(path.samples[narrowing.sample]));
        return json;
    };
    return {{"reference", figures_json(places->reference)},
            {"least_diameter", one(places->found.least_diameter)},
            {"equivalent_diameter", one(places->found.equivalent_diameter)},
            {"area", one(places->found.area)}};
}

ordered_json picture_json(const PaintedSlices& picture) {
    return {{"width", picture.image.width},
            {"height", picture.image.height},
            {"corner", {picture.corner.x, picture.corner.y}},
            {"size", {picture.size.x, picture.size.y}},
            {"tiles", {picture.tiles.x, picture.tiles.y}},
            {"gap", picture.gap},
            {"pixel_mm", picture.mm_per_pixel},
            {"window", {{"width", picture.window.width}, {"level", picture.window.level}}}};
}

std::string narrow_text(const char* what, const NarrowPlaces& places, const slice::VesselPath& path,
                        const Lengths& lengths) {
    const auto one = [&](const char* measure, const slice::Narrowing& narrowing) {
        const slice::PathSample& at = path.samples[narrowing.sample];
        return std::string(measure) + " " + rounded(narrowing.percent) + " % less at " + lengths.text(at.arc_mm, 4) +
               " (" + std::to_string(at.place.branch) + "@" + in_digits(at.place.fraction, 3) + ")";
    };
    return std::string(what) + one("least diameter", places.found.least_diameter) + ", " +
           one("equivalent diameter", places.found.equivalent_diameter) + ", " + one("area", places.found.area) + "\n";
}

} // namespace

ordered_json reformat_json(const ReformatFigures& figures, const tree::Claims& claims) {
    ordered_json parts = ordered_json::array();
    for (const slice::PathPart& part : figures.path.parts)
        parts.push_back({{"branch", part.branch},
                         {"from", part.from},
                         {"to", part.to},
                         {"begin_mm", part.begin_mm},
                         {"end_mm", part.end_mm}});
    ordered_json sections = ordered_json::array();
    for (std::size_t n = 0; n < figures.samples.size(); ++n) {
        const slice::PathSample& one = figures.samples[n];
        ordered_json section = sample_json(one);
        section["normal"] = place_json(one.tangent);
        section["file_radius_mm"] = one.radius_mm;
        section["surface"] = lumen_json(lumen_in(figures.sections.surface, n));
        if (!figures.sections.mask.empty()) section["mask"] = lumen_json(lumen_in(figures.sections.mask, n));
        sections.push_back(std::move(section));
    }
    ordered_json report{{"length_mm", figures.path.length_mm()},
                        {"step_mm", figures.path.step_mm},
                        {"units", claims.unit_word()},
                        {"path", parts}};
    report["picture"] = figures.picture ? picture_json(*figures.picture) : ordered_json();
    report["narrowest"] = {{"surface", narrow_json(figures.by_surface, figures.path)},
                           {"mask", narrow_json(figures.by_mask, figures.path)}};
    report["sections"] = std::move(sections);
    return report;
}

std::string reformat_text(const ReformatFigures& figures, const Lengths& lengths) {
    const auto closed =
        std::ranges::count_if(figures.sections.surface, [](const auto& lumen) { return lumen && lumen->closed; });
    std::string text = "path          " + lengths.text(figures.path.length_mm(), 4) + ", branches " +
                       joined(figures.path.parts, ", ", [](const auto& part) { return std::to_string(part.branch); }) +
                       "\nsections      " + grouped(figures.samples.size()) + ", " +
                       grouped(static_cast<std::uint64_t>(closed)) + " with a closed lumen\n";
    if (figures.by_surface) text += narrow_text("surface       ", *figures.by_surface, figures.path, lengths);
    if (figures.by_mask) text += narrow_text("mask          ", *figures.by_mask, figures.path, lengths);
    return text;
}

} // namespace ramus::app
