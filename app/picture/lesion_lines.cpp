#include "app/picture/lesion_lines.h"

#include "app/assets/assets.h"
#include "app/assets/lesion_text.h"
#include "app/assets/operation.h"
#include "app/picture/colouring.h"
#include "app/picture/place_marks.h"

#include <algorithm>

namespace ramus::app {

namespace {

void draw_distance(render::Frame& frame, const glm::dvec3& from, const glm::dvec3& to, const glm::vec3& colour,
                   float width, const std::string& text) {
    frame.lines.push_back({{from, to}, colour, width});
    for (const glm::dvec3& end : {from, to}) frame.lines.push_back(dot_at(frame, end, colour));
    frame.labels.push_back({0.5 * (from + to), latin1(text)});
}

// The colours of the surfaces of resections.
void explain_bands(render::Frame& frame, const std::vector<double>& bands_mm, const Lengths& lengths) {
    render::Legend& legend = frame.overlays.legend;
    legend.title += (legend.title.empty() ? "To lesion (" : ", to lesion (") + lengths.unit() + ")";
    const auto swatches = margin_swatches(bands_mm);
    legend.swatches.insert(legend.swatches.end(), swatches.begin(), swatches.end());
}

} // namespace

void draw_shortest_distances(render::Frame& frame, const Plan& plan, const Marks& marks, const PointedLesion& pointed,
                             const tree::Claims& claims) {
    constexpr glm::vec3 kLine{1.00F, 0.93F, 0.60F}, kPointed{1.00F, 0.99F, 0.90F};
    const Lengths lengths(claims);
    for (const measure::LesionVessels& vessels : plan.vessels) {
        const bool at = static_cast<int>(vessels.lesion) == pointed.lesion &&
                        (pointed.system < 0 || pointed.system == vessels.system);
        const measure::NearestWall& nearest = vessels.nearest;
        if (nearest.branch == tree::kNoBranch || !(at || marks.shortest_distances)) continue;
        if (!at && state_of(marks, nearest.branch) == tree::BranchState::kHidden) continue;
        const glm::vec3 colour = at ? kPointed : kLine;
        draw_distance(frame, nearest.on_lesion, nearest.on_wall, colour, at ? 3.0F : 2.0F,
                      nearest.overlap_mm > 0.0 ? "overlap " + lengths.text(nearest.overlap_mm)
                                               : distance_text(nearest, lengths));
    }
}

void draw_margins(render::Frame& frame, const Assets& assets, const Marks& marks) {
    constexpr glm::vec3 kLine{0.85F, 0.93F, 1.00F};
    const auto operation = operation_of(assets, marks, assets.organ.plan, OperationOf::kLast);
    if (!operation || std::ranges::none_of(marks.resections, &Resection::visible)) return;
    const Lengths lengths(operation->of.supply->of.mask->claims);
    if (!operation->margins.empty() && marks.colour_by != ColourBy::kLesion)
        explain_bands(frame, operation->of.bands_mm, lengths);
    for (std::size_t n = 0; n < operation->margins.size(); ++n) {
        const organ::Margin& margin = operation->margins[n];
        const auto index = lesion_index(marks, operation->of.lesions[n].id);
        if (!margin.distance_mm || !index || !marks.lesions[*index].visible) continue;
        const std::string text = *margin.distance_mm > 0.0 ? "margin " + lengths.text(*margin.distance_mm)
                                                           : "the cut passes through the lesion";
        draw_distance(frame, margin.on_lesion, margin.on_surface, kLine, 2.5F, text);
    }
}

} // namespace ramus::app
