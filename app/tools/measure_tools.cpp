#include "app/tools/measure_tools.h"

#include "app/session/numbers.h"
#include "app/tools/spelling.h"
#include "core/measure/branch_point.h"

#include <glm/geometric.hpp>

namespace ramus::app {

namespace {
const glm::vec4 kMeasureColour{0.55F, 0.95F, 0.75F, 1.0F};
}

void MeasureTool::press(const Pointing& pointing) {
    const render::Pick pick = pointing.pick();
    if (pick.branch < 0 || pick.branch >= pointing.document.branch_count()) return;
    const std::string branch = std::to_string(pick.branch);
    switch (kind_) {
    case Measurement::Kind::kDistance:
    case Measurement::Kind::kPath: {
        const auto first = std::exchange(first_, std::nullopt);
        if (!first)
            first_ = pick;
        else if (kind_ == Measurement::Kind::kPath)
            command({"measure", "path", std::to_string(first->branch), branch});
        else
            command({"measure", "distance", spelled(first->position), spelled(pick.position)});
        break;
    }
    case Measurement::Kind::kDiameter:
        command({"measure", "diameter", branch,
                 spelled(measure::nearest_fraction(*pointing.document.tree(), pick.branch, pick.position), 3)});
        break;
    case Measurement::Kind::kAngle:
        command({"measure", "angle", branch});
        break;
    }
}

void MeasureTool::move(const Pointing& pointing) {
    if (first_ && kind_ == Measurement::Kind::kDistance) under_ = pointing.pick();
}

ToolDrawing MeasureTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    if (!first_) return drawing;
    const auto from = render::project(pointing.camera(), pointing.size, first_->position);
    if (!from) return drawing;
    drawing.lines.push_back({{glm::dvec2(*from), pointing.at}, kMeasureColour, 1.5F, false});
    drawing.circles.push_back({glm::dvec2(*from), 3.5 * pointing.pixel_ratio, kMeasureColour, 1.5F, true});
    if (kind_ == Measurement::Kind::kDistance && under_.branch != render::kNoBranch)
        drawing.texts.push_back({pointing.at + glm::dvec2(14.0, 10.0) * static_cast<double>(pointing.pixel_ratio),
                                 digits(glm::distance(first_->position, under_.position)) + " mm", kMeasureColour});
    return drawing;
}

std::string MeasureTool::hint() const {
    switch (kind_) {
    case Measurement::Kind::kDistance:
        return first_ ? "Click the other place, Escape to begin again" : "Click a place on a vessel, then another";
    case Measurement::Kind::kPath:
        return first_ ? "Click the other branch, Escape to begin again"
                      : "Click two branches: the way along the vessels between their middles";
    case Measurement::Kind::kDiameter:
        return "Click a vessel: its diameter there";
    case Measurement::Kind::kAngle:
        return "Click a vessel: the angles where it branches off";
    }
    return {};
}

} // namespace ramus::app
