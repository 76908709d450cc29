#include "app/commands/validate_pictures.h"

#include "app/assets/centerlines.h"
#include "app/assets/validation.h"
#include "app/picture/compose.h"
#include "app/picture/deviation_colours.h"
#include "app/picture/fit.h"
#include "app/picture/place_marks.h"
#include "app/reports/validation/validation_tables.h"
#include "app/workspace/surface_maker.h"
#include "core/measure/deviation/deviation.h"
#include "core/measure/deviation/packed_triangles.h"
#include "core/validate/worst_radii.h"
#include "render/gl/headless_context.h"
#include "render/image/image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <utility>

namespace ramus::app {

namespace {

constexpr std::size_t kMostMarked = 500;  // findings of one kind: more marks would hide the surface
constexpr std::size_t kMostLettered = 25; // findings of one kind with a label
constexpr double kAroundVessel = 1.25;    // radius of a ring, in radii of the vessel
constexpr std::size_t kMostCloseUps = 12; // per data set
constexpr glm::vec3 kCloseUpRing{0.94F, 0.90F, 0.26F};

// Colours of findings: distinguishable for colour-blind people (M. Okabe and K. Ito, 2008), light against the
// background.
struct MarkKind {
    char letter;
    const char* words;
    glm::vec3 colour;
    std::vector<glm::dvec3> places;
};

template <class List> std::vector<glm::dvec3> places_of(const List& list) {
    std::vector<glm::dvec3> places;
    for (const auto& one : list) places.push_back(one.at);
    return places;
}

std::vector<MarkKind> marks_of(const ValidatedDataSet& set) {
    const validate::Validation& found = set.validation;
    std::vector<MarkKind> kinds{
        {kLostLetter, "Lost", {0.94F, 0.42F, 0.13F}, places_of(found.lost)},
        {kFalseLetter, "False", {0.94F, 0.90F, 0.26F}, places_of(found.false_parts)},
        {kMergedLetter, "Merged", {0.34F, 0.71F, 0.92F}, places_of(found.merged)},
        {kConstrictionLetter, "Changed constriction", {0.87F, 0.56F, 0.75F}, places_of(found.constrictions)},
        {kWidthLetter, "Changed width", {0.0F, 0.62F, 0.45F}, places_of(found.widths)},
        {kPositionLetter, "Moved", {0.60F, 0.60F, 1.0F}, places_of(found.positions)},
        {kFarLetter, "Farthest from cones", {0.94F, 0.94F, 0.94F}, places_of(set.to_cones.farthest)}};
    std::erase_if(kinds, [](const MarkKind& kind) { return kind.places.empty(); });
    return kinds;
}

void mark(render::Frame& frame, const ValidatedDataSet& set) {
    frame.overlays.legend.title = "Places";
    for (const MarkKind& kind : marks_of(set)) {
        frame.overlays.legend.swatches.push_back({kind.colour, std::string(1, kind.letter) + ": " + kind.words, false});
        for (std::size_t i = 0; i < std::min(kind.places.size(), kMostMarked); ++i) {
            const validate::RadiusPlace* vessel = validate::nearest_place(set.validation, kind.places[i]);
            frame.lines.push_back(ring_facing_eye(
                frame, kind.places[i], vessel != nullptr ? kAroundVessel * vessel->input_mm : 0.0, kind.colour, false));
            if (kind.places.size() <= kMostLettered)
                frame.labels.push_back({kind.places[i], place_code(kind.letter, i)});
        }
    }
}

char letter_of(Finding::Kind kind) {
    switch (kind) {
    case Finding::Kind::kLost:
        return kLostLetter;
    case Finding::Kind::kFalse:
        return kFalseLetter;
    case Finding::Kind::kMerged:
        return kMergedLetter;
    case Finding::Kind::kConstriction:
        return kConstrictionLetter;
    case Finding::Kind::kWidth:
        return kWidthLetter;
    case Finding::Kind::kPosition:
        return kPositionLetter;
    case Finding::Kind::kRadius:
        return kFarLetter;
    }
    return kFarLetter;
}

// Looks across the vessel, from the side where the least surface is in front of the place.
render::Camera close_to(const Finding& finding, const validate::Validation& found, const render::Camera& whole,
                        glm::ivec2 size, const measure::PackedTriangles& triangles) {
    constexpr int kSides = 16;
    constexpr double kAround = 0.4; // factor for looking_at(): the edge of the picture is six radii away
    const validate::RadiusPlace* vessel = validate::nearest_place(found, finding.at);
    const glm::dvec3 along = vessel != nullptr ? vessel->direction : glm::dvec3(0.0, 0.0, 1.0);
    const double vessel_mm = vessel != nullptr ? vessel->input_mm : 0.0;
    render::Camera camera = looking_at(whole, finding.at, kAround * std::max(finding.radius_mm, vessel_mm), size);
    const render::CameraAxes axes = render::axes_of(whole);
    glm::dvec3 first = axes.forward - glm::dot(axes.forward, along) * along;
    if (glm::length(first) < 0.1) first = axes.right - glm::dot(axes.right, along) * along;
    first = glm::normalize(first);
    const glm::dvec3 second = glm::cross(along, first);
    const double distance = glm::distance(camera.position, finding.at);
    std::vector<measure::Crossing> crossings;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    glm::dvec3 forward = first;
    for (int side = 0; side < kSides; ++side) {
        const double angle = 2.0 * std::numbers::pi * side / kSides;
        const glm::dvec3 way = std::cos(angle) * first + std::sin(angle) * second;
        triangles.crossings(finding.at, -way, distance, crossings);
        if (crossings.size() < least) least = crossings.size(), forward = way;
    }
    camera.position = finding.at - distance * forward;
    if (glm::length(glm::cross(axes.up, forward)) < 0.1) camera.view_up = axes.right;
    return camera;
}

} // namespace

Result<std::unique_ptr<ValidationPainter>> ValidationPainter::create(bool few) {
    std::unique_ptr<ValidationPainter> painter(new ValidationPainter);
    painter->few_ = few;
    RAMUS_TRY(context, render::make_headless_context(render::Backend::kOsMesa, std::nullopt));
    painter->context_ = std::move(context);
    RAMUS_TRY(renderer, render::Renderer::create());
    painter->renderer_ = std::move(renderer);
    return painter;
}

Result<ReportPicture> ValidationPainter::draw(const render::Frame& frame, std::string caption) {
    if (const auto drawn = renderer_->draw(frame); !drawn) return tl::unexpected(drawn.error());
    if (few_)
        if (const auto finer = renderer_->refine(); !finer) return tl::unexpected(finer.error());
    RAMUS_TRY(png, render::encode_png(renderer_->read_image()));
    return ReportPicture{std::move(caption), std::move(png)};
}

Result<void> ValidationPainter::paint(const PaintedSurface& surface, ValidatedDataSet& set) {
    render::Frame frame;
    frame.mesh = paged(surface.mesh, surface.tree);
    show_claims(frame, surface.tree.claims);
    frame.size = few_ ? glm::ivec2{720, 576} : glm::ivec2{640, 512};
    frame.camera = render::camera_for(frame.mesh->positions(), render::View::kAnterior, frame.size);
    if (auto done = paint_whole(frame, surface, set); !done) return done;
    if (auto done = paint_deviations(frame, surface, set); !done) return done;
    return paint_places(std::move(frame), surface, set);
}

Result<void> ValidationPainter::paint_whole(const render::Frame& frame, const PaintedSurface& surface,
                                            ValidatedDataSet& set) {
    const bool sides = surface.tree.claims.has_sides();
    const auto from = [&](render::View view, glm::ivec2 size) {
        render::Frame seen = frame;
        seen.size = size;
        seen.camera = render::camera_for(frame.mesh->positions(), view, size);
        return seen;
    };
    render::Frame marked = from(render::View::kAnterior, few_ ? glm::ivec2{1200, 840} : frame.size);
    mark(marked, set);
    RAMUS_TRY(places, draw(marked, std::string(sides ? "From the front (anterior)" : "From +y") +
                                       ", with the found places and those farthest from the truncated cones"));
    set.pictures.push_back(std::move(places));
    RAMUS_TRY(front, draw(frame, sides ? "The surface from the front (anterior)" : "The surface from +y"));
    set.pictures.push_back(std::move(front));
    if (!few_) return {};
    RAMUS_TRY(side, draw(from(render::View::kLeft, frame.size), sides ? "From the patient's left" : "From -x"));
    set.pictures.push_back(std::move(side));
    return {};
}

Result<void> ValidationPainter::paint_deviations(render::Frame frame, const PaintedSurface& surface,
                                                 ValidatedDataSet& set) {
    const auto mesh = frame.mesh;
    const auto paint = [&](const std::vector<float>& mm, const SurfaceDistances& distances,
                           DeviationChoice::From from) -> Result<void> {
        if (mm.empty()) return {};
        Marks marks;
        marks.deviation.from = from;
        marks.comparison.mask = set.mask;
        std::vector<double> values(mm.begin(), mm.end());
        SurfaceDeviation deviation;
        deviation.most_mm = distances.statistics.max;
        deviation.percentile_99_mm = measure::quantile(values, 0.99);
        show_deviation(frame, marks, &deviation);
        frame.overlays.legend.title = surface.tree.claims.worded(frame.overlays.legend.title);
        frame.mesh = std::make_shared<const render::PagedMesh>(mesh->with_values(mm));
        RAMUS_TRY(picture, draw(frame, "How far the surface is from the " + noun_of(marks.deviation, marks.comparison) +
                                           ": the scale ends above 99 % of its vertices"));
        set.pictures.push_back(std::move(picture));
        return {};
    };
    if (auto done = paint(surface.to_cones_mm, set.to_cones, DeviationChoice::From::kCones); !done) return done;
    if (!set.to_mask) return {};
    return paint(surface.to_mask_mm, *set.to_mask, DeviationChoice::From::kIsosurface);
}

Result<void> ValidationPainter::paint_places(render::Frame frame, const PaintedSurface& surface,
                                             ValidatedDataSet& set) {
    std::vector<Finding> findings = findings_of(set.validation);
    std::erase_if(findings, [](const Finding& finding) { return finding.kind == Finding::Kind::kRadius; });
    if (findings.empty()) return {};
    frame.skeleton = centerlines_of(surface.tree, surface.options).lines;
    const measure::PackedTriangles triangles(surface.mesh);
    const render::Camera whole = frame.camera;
    const Lengths lengths(surface.tree.claims);
    std::map<Finding::Kind, std::size_t> counted;
    const std::size_t most = few_ ? kMostCloseUps : kMostCloseUps / 4;
    for (std::size_t i = 0; i < std::min(most, findings.size()); ++i) {
        const Finding& finding = findings[i];
        frame.camera = close_to(finding, set.validation, whole, frame.size, triangles);
        const std::string code = place_code(letter_of(finding.kind), counted[finding.kind]++);
        frame.labels = {{finding.at, code}};
        frame.lines = {ring_facing_eye(frame, finding.at, 0.0, kCloseUpRing, true)};
        std::string caption = code + ": " + std::string(name_of(finding.kind)) + ", " + text_of(finding, lengths);
        for (const int branch : finding.branches) caption += ", branch " + std::to_string(branch);
        RAMUS_TRY(picture, draw(frame, caption + "; with centerlines, and rings of the tree's radius"));
        set.close_ups.push_back(std::move(picture));
    }
    return {};
}

} // namespace ramus::app
