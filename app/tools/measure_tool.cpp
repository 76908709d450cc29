#include "app/tools/measure_tool.h"

#include "app/tools/spelling.h"
#include "core/measure/branch_point.h"

#include <glm/geometric.hpp>
#include <span>
#include <utility>

namespace ramus::app {

namespace {

const glm::vec4 kMeasureColour{0.55F, 0.95F, 0.75F, 1.0F};
const glm::vec4 kRefusedMeasureColour{1.0F, 0.55F, 0.45F, 1.0F};
constexpr double kHandlePoints = 4.5; // radius of a handle
constexpr double kReachPoints = 9.0;  // that a press may miss its middle by
constexpr double kStillPoints = 4.0;  // a pointer that moved less was only clicked

bool on_vessel(const Pointing& pointing, const render::Pick& pick) {
    return pick.branch >= 0 && pick.branch < pointing.document.branch_count();
}

measure::BranchPlace foot_of(const Pointing& pointing, const render::Pick& pick) {
    return {pick.branch, measure::nearest_fraction(*pointing.document.tree(), pick.branch, pick.position)};
}

bool went_away(const Pointing& pointing, glm::dvec2 pressed_at) {
    return glm::distance(pointing.at, pressed_at) >= kStillPoints * pointing.pixel_ratio;
}

// As the command `measure` takes it.
std::vector<std::string> words_of(const Measurement& m) {
    switch (m.kind) {
    case Measurement::Kind::kDistance:
        return {"distance", finely_spelled(m.points[0]), finely_spelled(m.points[1])};
    case Measurement::Kind::kPath:
    case Measurement::Kind::kDiameter:
    case Measurement::Kind::kAngle:
        break;
    }
    std::vector<std::string> words{m.kind == Measurement::Kind::kPath       ? "path"
                                   : m.kind == Measurement::Kind::kDiameter ? "diameter"
                                                                            : "angle"};
    for (const measure::BranchPlace& place : std::span(m.places).first(place_count(m))) {
        words.push_back(std::to_string(place.branch));
        words.push_back(spelled(place.fraction, 5));
    }
    return words;
}

} // namespace

// Branchings have no end to move.
std::optional<MeasureTool::Handle> MeasureTool::handle_under(const Pointing& pointing) {
    if (!pointing.document.tree()) return {};
    std::optional<Handle> found;
    double nearest = kReachPoints * pointing.pixel_ratio;
    const auto& measurements = pointing.document.marks().measurements;
    for (std::size_t m = 0; m < measurements.size(); ++m) {
        const std::vector<glm::dvec3> ends = ends_of(*pointing.document.tree(), measurements[m]);
        for (std::size_t e = 0; e < ends.size(); ++e) {
            const auto at = render::project(pointing.camera(), pointing.size, ends[e]);
            if (!at) continue;
            if (const double away = glm::distance(glm::dvec2(*at), pointing.at); away < nearest)
                nearest = away, found = Handle{m, e};
        }
    }
    return found;
}

std::size_t MeasureTool::points_wanted() const {
    switch (kind_) {
    case Measurement::Kind::kDistance:
    case Measurement::Kind::kPath:
        return 2;
    case Measurement::Kind::kDiameter:
        return 1;
    case Measurement::Kind::kAngle:
        return 3;
    }
    return 1;
}

Measurement MeasureTool::measurement_of(const Pointing& pointing, const std::vector<render::Pick>& picks) const {
    Measurement found{.kind = kind_};
    for (std::size_t i = 0; i < picks.size(); ++i)
        if (kind_ == Measurement::Kind::kDistance)
            found.points[i] = picks[i].position;
        else
            found.places[i] = foot_of(pointing, picks[i]);
    return found;
}

void MeasureTool::press(const Pointing& pointing) {
    pressed_at_ = pointing.at;
    if (begun_.empty())
        if (const auto handle = handle_under(pointing)) {
            const Measurement& there = pointing.document.marks().measurements[handle->measurement];
            held_ = Held{*handle, there, there, pointing.at};
            return;
        }
    take_point(pointing);
}

const MeasureTool::Held* MeasureTool::held(const Pointing& pointing) const {
    if (!held_) return nullptr;
    const auto& measurements = pointing.document.marks().measurements;
    const std::size_t index = held_->handle.measurement;
    return index < measurements.size() && measurements[index] == held_->before ? &*held_ : nullptr;
}

void MeasureTool::take_point(const Pointing& pointing) {
    const render::Pick pick = pointing.pick();
    if (!on_vessel(pointing, pick)) return;
    begun_.push_back(pick);
    under_ = pick.position;
    live_.reset();
    if (begun_.size() < points_wanted()) return;
    std::vector<std::string> line = words_of(measurement_of(pointing, std::exchange(begun_, {})));
    line.insert(line.begin(), "measure");
    command(std::move(line));
}

void MeasureTool::move(const Pointing& pointing) {
    if (held_ && held(pointing) == nullptr) escape();
    over_handle_ = held_ || (begun_.empty() && handle_under(pointing));
    if (!held_) return look(pointing);
    if (!held_->moved && !went_away(pointing, held_->pressed_at)) return;
    held_->moved = true;
    const render::Pick pick = pointing.pick();
    if (!on_vessel(pointing, pick)) return;
    if (held_->now.kind == Measurement::Kind::kDistance)
        held_->now.points[held_->handle.end] = pick.position;
    else
        held_->now.places[held_->handle.end] = foot_of(pointing, pick);
    live_ = measured(*pointing.document.tree(), held_->now);
}

void MeasureTool::look(const Pointing& pointing) {
    live_.reset();
    if (begun_.empty() && (points_wanted() > 1 || over_handle_)) return;
    const render::Pick pick = pointing.pick();
    if (!on_vessel(pointing, pick)) return;
    under_ = pick.position;
    if (begun_.size() + 1 < points_wanted()) return;
    std::vector<render::Pick> picks = begun_;
    picks.push_back(pick);
    live_ = measured(*pointing.document.tree(), measurement_of(pointing, picks));
}

// A press that did not move is a click, on a handle too: what is measured next may begin where another one ends.
void MeasureTool::release(const Pointing& pointing) {
    if (held_ && held(pointing) == nullptr) return void(escape());
    const auto held = std::exchange(held_, std::nullopt);
    if (held && !held->moved) return take_point(pointing);
    if (!held) {
        if (begun_.size() == 1 && points_wanted() == 2 && went_away(pointing, pressed_at_)) take_point(pointing);
        return;
    }
    const bool measures = live_ && *live_;
    live_.reset();
    if (!measures) return;
    std::vector<std::string> line = words_of(held->now);
    line.insert(line.begin(), {"measure-change", std::to_string(held->handle.measurement + 1)});
    command(std::move(line));
}

bool MeasureTool::escape() {
    live_.reset();
    over_handle_ = false;
    const bool held = std::exchange(held_, std::nullopt).has_value();
    return !std::exchange(begun_, {}).empty() || held;
}

std::optional<std::size_t> MeasureTool::moved_measurement() const {
    return held_ && held_->moved && live_ ? std::optional(held_->handle.measurement) : std::nullopt;
}

ToolDrawing MeasureTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    if (!pointing.document.tree()) return drawing;
    const double ratio = pointing.pixel_ratio;
    const auto put = [&](const glm::dvec3& place) { return render::project(pointing.camera(), pointing.size, place); };
    const auto dot = [&](const glm::dvec3& place, double points, bool filled) {
        if (const auto at = put(place))
            drawing.circles.push_back({glm::dvec2(*at), points * ratio, kMeasureColour, 1.5F, filled});
    };
    const Held* const held = this->held(pointing);
    const auto moved = held != nullptr ? moved_measurement() : std::nullopt;
    const auto& measurements = pointing.document.marks().measurements;
    for (std::size_t m = 0; m < measurements.size(); ++m)
        if (m != moved)
            for (const glm::dvec3& end : ends_of(*pointing.document.tree(), measurements[m]))
                dot(end, kHandlePoints, true);
    if (const auto handle = held != nullptr ? held->handle : handle_under(pointing); handle && begun_.empty() && !moved)
        dot(ends_of(*pointing.document.tree(), measurements[handle->measurement])[handle->end], 1.6 * kHandlePoints,
            false);
    for (const render::Pick& pick : begun_) dot(pick.position, kHandlePoints, true);
    if (held_ && held == nullptr) return drawing;
    const bool known = live_ && *live_;
    if (!begun_.empty() && !known)
        if (const auto from = put(begun_.back().position))
            drawing.lines.push_back({{glm::dvec2(*from), pointing.at}, kMeasureColour, 1.5F, false});
    if (!live_) return drawing;
    const glm::dvec2 beside = pointing.at + glm::dvec2(14.0, 10.0) * ratio;
    if (!known) {
        drawing.texts.push_back({beside, live_->error().what, kRefusedMeasureColour});
        return drawing;
    }
    for (const auto& line : (*live_)->lines) {
        ToolDrawing::Line seen{.points = {}, .colour = kMeasureColour, .width = 2.0F, .closed = false};
        for (const glm::dvec3& place : line)
            if (const auto at = put(place)) seen.points.emplace_back(*at);
        if (seen.points.size() == line.size()) drawing.lines.push_back(std::move(seen));
    }
    for (const glm::dvec3& end : (*live_)->ends) dot(end, kHandlePoints, true);
    drawing.texts.push_back({beside, (*live_)->kind + " " + (*live_)->value_text(), kMeasureColour});
    return drawing;
}

bool MeasureTool::points_at_branches() const {
    return (kind_ == Measurement::Kind::kPath || kind_ == Measurement::Kind::kAngle) && !busy() && !over_handle_;
}

std::string MeasureTool::hint() const {
    if (held_) return "Drag the end to another place, let go to keep it, Escape to leave it";
    if (!begun_.empty()) {
        if (kind_ == Measurement::Kind::kAngle && begun_.size() == 1)
            return "Click where the angle is, then the other place, Escape to begin again";
        return "Click the other place, Escape to begin again";
    }
    const std::string handles = "; drag an end of a measurement to move it";
    switch (kind_) {
    case Measurement::Kind::kDistance:
        return "Click a place on a vessel, then another, or drag from one to the other" + handles;
    case Measurement::Kind::kPath:
        return "Click two places: the path along the vessels between them" + handles;
    case Measurement::Kind::kDiameter:
        return "Click a vessel: its diameter there" + handles;
    case Measurement::Kind::kAngle:
        return "Click three places on vessels: the angle is at the second" + handles;
    }
    return {};
}

} // namespace ramus::app
