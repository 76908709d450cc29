#include "app/picture/marks_drawing.h"

#include "app/assets/ring.h"

namespace ramus::app {

namespace {

constexpr glm::vec3 kCutColour{0.94F, 0.95F, 0.97F}, kReconstructColour{1.00F, 0.62F, 0.20F},
    kMeasureColour{0.55F, 0.93F, 0.82F};

} // namespace

void draw_cuts(render::Frame& frame, const Marks& marks, const Plan* plan) {
    for (std::size_t i = 0; i < marks.cuts.size() && frame.centerlines; ++i) {
        const auto& [branch, fraction] = marks.cuts[i];
        const auto place = frame.centerlines->at(branch, fraction);
        if (!place || state_of(marks, branch) == render::BranchState::kHidden) continue;
        const bool reconstruct = plan != nullptr && i < plan->cuts.cuts.size() && plan->cuts.cuts[i].reconstruct;
        frame.lines.push_back({ring_around(place->position, place->along, 1.35 * place->radius_mm),
                               reconstruct ? kReconstructColour : kCutColour, 2.2F});
    }
}

void draw_measurements(render::Frame& frame, std::span<const Result<Measured>> measurements) {
    for (const Result<Measured>& found : measurements) {
        if (!found) continue;
        for (const auto& line : found->lines) frame.lines.push_back({line, kMeasureColour});
        frame.labels.push_back({found->label_place, found->label});
    }
}

} // namespace ramus::app
