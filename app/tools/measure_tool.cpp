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
constexpr double kReachPoints = 9.0;  // distance by which a press may miss it
constexpr double kStillPoints = 4.0;  // a pointer that moved less was only clicked

bool on_vessel(const Pointing& pointing, const render::Pick& pick) {
    return pick.branch >= 0 && pick.branch < pointing.document.branch_count();
}

// The id of the lesion that a pick shows.
int lesion_of(const Pointing& pointing, const render::Pick& pick) {
    return on_vessel(pointing, pick) ? kNoObject : pointing.lesions.picked(pick.lesion);
}

// An end of a distance: on a vessel where it was clicked, on a lesion at the nearest place of its surface.
void put_end(Measurement& distance, std::size_t end, const Pointing& pointing, const render::Pick& pick) {
    const int lesion = lesion_of(pointing, pick);
    const auto shape = pointing.lesions.at(lesion);
    distance.lesions[end] = shape ? lesion : kNoObject;
    distance.points[end] = shape ? measure::nearest_on(*shape, pick.position) : pick.position;
}

measure::BranchPlace foot_of(const Pointing& pointing, const render::Pick& pick) {
    return {pick.branch, measure::nearest_fraction(*pointing.document.tree(), pick.branch, pick.position)};
}

bool went_away(const Pointing& pointing, glm::dvec2 pressed_at) {
    return glm::distance(pointing.at, pressed_at) >= kStillPoints * pointing.pixel_ratio;
}

// Arguments of the command `measure`.
std::vector<std::string> words_of(const Measurement& m, const Marks& marks) {
    const auto lesion = [&](std::size_t i) {
        return "lesion:" + std::to_string(lesion_index(marks, m.lesions[i]).value_or(marks.lesions.size()) + 1);
    };
    const auto end = [&](std::size_t i) {
        return (m.lesions[i] != kNoObject ? lesion(i) + "@" : "") + finely_spelled(m.points[i]);
    };
    switch (m.kind) {
    case Measurement::Kind::kDistance:
        if (m.shortest) return {"distance", lesion(0), "branch:" + std::to_string(m.places[0].branch)};
        return {"distance", end(0), end(1)};
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

// Angles at branchings have no movable end.
std::optional<MeasureTool::Handle> MeasureTool::handle_under(const Pointing& pointing) {
    if (!pointing.document.has_scene()) return {};
    std::optional<Handle> found;
    double nearest = kReachPoints * pointing.pixel_ratio;
    const auto& measurements = pointing.document.marks().measurements;
    for (std::size_t m = 0; m < measurements.size(); ++m) {
        const std::vector<glm::dvec3> ends = ends_of(*measured_tree(pointing.document), measurements[m]);
        for (std::size_t e = 0; e < ends.size(); ++e) {
            const auto at = render::project(pointing.camera(), pointing.size, ends[e]);
            if (!at || !pointing.shows(ends[e])) continue;
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
    if (whole_ && picks.size() == 2)
        for (std::size_t i = 0; i < 2; ++i) {
            const int lesion = lesion_of(pointing, picks[i]);
            if (lesion == kNoObject || !on_vessel(pointing, picks[1 - i])) continue;
            found.shortest = true;
            found.lesions[0] = lesion;
            found.places[0] = foot_of(pointing, picks[1 - i]);
            return found;
        }
    for (std::size_t i = 0; i < picks.size(); ++i)
        if (kind_ == Measurement::Kind::kDistance)
            put_end(found, i, pointing, picks[i]);
        else
            found.places[i] = foot_of(pointing, picks[i]);
    return found;
}

bool MeasureTool::takes(const Pointing& pointing, const render::Pick& pick) const {
    return on_vessel(pointing, pick) || (kind_ == Measurement::Kind::kDistance &&
                                         (pointing.on_scan(pick) || pointing.lesions.at(lesion_of(pointing, pick))));
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
    if (!takes(pointing, pick)) return;
    if (pointing.modifiers.shift && lesion_of(pointing, pick) != kNoObject) whole_ = true;
    begun_.push_back(pick);
    under_ = pick.position;
    live_.reset();
    if (begun_.size() < points_wanted()) return;
    std::vector<std::string> line =
        words_of(measurement_of(pointing, std::exchange(begun_, {})), pointing.document.marks());
    whole_ = false;
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
    const bool distance = held_->now.kind == Measurement::Kind::kDistance;
    if (!on_vessel(pointing, pick) && !(distance && (pointing.on_scan(pick) || lesion_of(pointing, pick) != kNoObject)))
        return;
    if (distance)
        put_end(held_->now, held_->handle.end, pointing, pick);
    else
        held_->now.places[held_->handle.end] = foot_of(pointing, pick);
    live_ = measured(*measured_tree(pointing.document), held_->now, pointing.lesions);
}

void MeasureTool::look(const Pointing& pointing) {
    live_.reset();
    snapped_.clear();
    const render::Pick pick = pointing.pick();
    const bool can_take = takes(pointing, pick) && !over_handle_;
    if (const int lesion = lesion_of(pointing, pick); can_take && lesion != kNoObject)
        snapped_ = pointing.lesions.name_of(lesion);
    if (can_take) under_ = pick.position;
    if (!can_take || (begun_.empty() && points_wanted() > 1)) return;
    if (begun_.size() + 1 < points_wanted()) return;
    std::vector<render::Pick> picks = begun_;
    picks.push_back(pick);
    live_ = measured(*measured_tree(pointing.document), measurement_of(pointing, picks), pointing.lesions);
}

// A press without a move is a click, even on a handle: a new measurement may begin where another one ends.
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
    std::vector<std::string> line = words_of(held->now, pointing.document.marks());
    line.insert(line.begin(), {"measure-change", std::to_string(held->handle.measurement + 1)});
    command(std::move(line));
}

bool MeasureTool::escape() {
    live_.reset();
    over_handle_ = whole_ = false;
    snapped_.clear();
    const bool held = std::exchange(held_, std::nullopt).has_value();
    return !std::exchange(begun_, {}).empty() || held;
}

std::optional<std::size_t> MeasureTool::moved_measurement() const {
    return held_ && held_->moved && live_ ? std::optional(held_->handle.measurement) : std::nullopt;
}

ToolDrawing MeasureTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    if (!pointing.document.has_scene()) return drawing;
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
            for (const glm::dvec3& end : ends_of(*measured_tree(pointing.document), measurements[m]))
                if (pointing.shows(end)) dot(end, kHandlePoints, true);
    if (const auto handle = held != nullptr ? held->handle : handle_under(pointing); handle && begun_.empty() && !moved)
        dot(ends_of(*measured_tree(pointing.document), measurements[handle->measurement])[handle->end],
            1.6 * kHandlePoints, false);
    // On a slice through another place, the feet of the clicks are hollow.
    for (const render::Pick& pick : begun_) dot(pick.position, kHandlePoints, pointing.shows(pick.position));
    if (held_ && held == nullptr) return drawing;
    const bool known = live_ && *live_;
    if (!begun_.empty() && !known)
        if (const auto from = put(begun_.back().position))
            drawing.lines.push_back({{glm::dvec2(*from), pointing.at}, kMeasureColour, 1.5F, false});
    const glm::dvec2 beside = pointing.at + glm::dvec2(14.0, 10.0) * ratio;
    if (!live_ && !snapped_.empty()) {
        dot(under_, kHandlePoints, true);
        drawing.texts.push_back({beside, "On " + snapped_, kMeasureColour});
    }
    if (!live_) return drawing;
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
    drawing.texts.push_back(
        {beside, (*live_)->kind + " " + (*live_)->value_text() + (snapped_.empty() || held_ ? "" : " to " + snapped_),
         kMeasureColour});
    return drawing;
}

bool MeasureTool::points_at_branches() const {
    return (kind_ == Measurement::Kind::kPath || kind_ == Measurement::Kind::kAngle) && !busy() && !over_handle_;
}

std::string MeasureTool::hint() const {
    if (held_) return "Drag the end to another place, let go to keep it, Escape to leave it";
    if (!begun_.empty() && whole_) return "Click a vessel: the shortest distance to it, Escape to begin again";
    if (!snapped_.empty())
        return "On " + snapped_ +
               ": click for a place of its surface, Shift+click for the shortest distance to a vessel";
    if (!begun_.empty()) {
        if (kind_ == Measurement::Kind::kAngle && begun_.size() == 1)
            return "Click where the angle is, then the other place, Escape to begin again";
        return "Click the other place, Escape to begin again";
    }
    const std::string handles = "; drag an end of a measurement to move it";
    switch (kind_) {
    case Measurement::Kind::kDistance:
        return "Click a place on a vessel, a lesion or a slice, then another, or drag from one to the other" + handles;
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
