#include "app/commands/validate_pictures.h"

#include "app/picture/compose.h"
#include "app/picture/place_marks.h"
#include "app/reports/validation/validation_tables.h"
#include "app/workspace/surface_maker.h"
#include "core/validate/worst_radii.h"
#include "render/gl/headless_context.h"
#include "render/image/image.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace ramus::app {

namespace {

constexpr std::size_t kMostMarked = 500;  // of one kind: more would hide what they mark
constexpr std::size_t kMostLettered = 25; // likewise
constexpr double kAroundVessel = 1.25;    // radius of a ring, in the vessel's

// What is found, told apart by colour-blind eyes too (M. Okabe and K. Ito, 2008), light enough for the background.
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
            frame.lines.push_back(ring_facing_eye(frame, kind.places[i],
                                                  vessel != nullptr ? kAroundVessel * vessel->expected_mm : 0.0,
                                                  kind.colour, false));
            if (kind.places.size() <= kMostLettered)
                frame.labels.push_back({kind.places[i], place_code(kind.letter, i)});
        }
    }
}

// Meshes of other programs have neither.
void complete_arrays(mesh::TriangleMesh& mesh) {
    if (mesh.branches.empty()) mesh.branches.assign(mesh.positions.size(), 0);
    if (mesh.radii.empty()) mesh.radii.assign(mesh.positions.size(), 0.0F);
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
    if (few_) (void)renderer_->refine();
    RAMUS_TRY(png, render::encode_png(renderer_->read_image()));
    return ReportPicture{std::move(caption), std::move(png)};
}

Result<std::vector<ReportPicture>> ValidationPainter::pictures(mesh::TriangleMesh surface, const tree::VesselTree& tree,
                                                               const ValidatedDataSet& set) {
    complete_arrays(surface);
    render::Frame frame;
    frame.mesh = paged(surface, tree);
    show_claims(frame, tree.claims);
    const bool sides = tree.claims.has_sides();
    surface = {};
    const auto look = [&](render::View view, glm::ivec2 size) {
        frame.size = size;
        frame.camera = render::camera_for(frame.mesh->positions(), view, size);
    };
    const glm::ivec2 small = few_ ? glm::ivec2{720, 576} : glm::ivec2{640, 512};
    render::Frame marked;
    std::vector<ReportPicture> pictures;
    look(render::View::kAnterior, few_ ? glm::ivec2{1200, 840} : small);
    marked = frame;
    mark(marked, set);
    RAMUS_TRY(places, draw(marked, std::string(sides ? "From the front (anterior)" : "From +y") +
                                       ", with the found places and those farthest from the truncated cones"));
    pictures.push_back(std::move(places));
    look(render::View::kAnterior, small);
    RAMUS_TRY(front, draw(frame, sides ? "The surface from the front (anterior)" : "The surface from +y"));
    pictures.push_back(std::move(front));
    if (!few_) return pictures;
    look(render::View::kLeft, small);
    RAMUS_TRY(side, draw(frame, sides ? "From the patient's left" : "From -x"));
    pictures.push_back(std::move(side));
    return pictures;
}

} // namespace ramus::app
