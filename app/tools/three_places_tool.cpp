#include "app/tools/three_places_tool.h"

#include "app/tools/spelling.h"

#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

const glm::vec4 kObliqueColour{0.72F, 0.56F, 0.98F, 1.0F};
const glm::vec4 kPlaneColour{0.98F, 0.92F, 0.78F, 1.0F};
constexpr double kPlaceRadius = 4.5;    // points
constexpr double kLargestOfClick = 8.0; // points: a pointer that moved farther did not click
constexpr std::size_t kPlaces = 3;

bool is_place(const Pointing& pointing, const render::Pick& pick) {
    return pick.branch != render::kNoBranch || pointing.on_scan(pick);
}

// What three places are for.
struct ThreePlaces {
    CommandLine line; // the command, without the places
    glm::vec4 colour;
    std::string goal;    // after "Click three places on vessels or slices: "
    bool leaves;         // the tool is left when the command is given
    bool on_every_slice; // also draws places that the slice under the pointer does not show
};

class ThreePlacesTool final : public Tool {
public:
    explicit ThreePlacesTool(ThreePlaces of) : of_(std::move(of)) {}
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kBoth; }
    void press(const Pointing& pointing) override { pressed_at_ = pointing.at; }
    void move(const Pointing& pointing) override { under_ = pointing.pick(); }
    void release(const Pointing& pointing) override {
        const render::Pick& pick = pointing.pick();
        const bool clicked = glm::distance(pointing.at, pressed_at_) < kLargestOfClick * pointing.pixel_ratio;
        if (!clicked || !is_place(pointing, pick)) return;
        places_.push_back(pick.position);
        if (places_.size() < kPlaces) return;
        CommandLine line = of_.line;
        for (const glm::dvec3& place : std::exchange(places_, {})) line.push_back(finely_spelled(place));
        command(std::move(line));
        if (of_.leaves) command({"tool", "navigate"});
    }
    bool escape() override { return !std::exchange(places_, {}).empty(); }
    [[nodiscard]] bool busy() const override { return !places_.empty(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override {
        ToolDrawing drawing;
        std::vector<glm::dvec2> corners;
        const auto mark = [&](const glm::dvec3& place, bool set) {
            const auto at = render::project(pointing.camera(), pointing.size, place);
            if (!at || !(of_.on_every_slice || pointing.shows(place))) return;
            corners.emplace_back(*at);
            drawing.circles.push_back({glm::dvec2(*at), kPlaceRadius * pointing.pixel_ratio, of_.colour, 1.5F, set});
        };
        for (const glm::dvec3& place : places_) mark(place, true);
        if (is_place(pointing, under_)) mark(under_.position, false);
        if (corners.size() == kPlaces) corners.push_back(corners.front());
        if (corners.size() > 1) drawing.lines.push_back({corners, of_.colour, 1.5F, false});
        return drawing;
    }
    [[nodiscard]] std::string hint() const override {
        if (places_.empty()) return "Click three places on vessels or slices: " + of_.goal;
        return "Click " + std::string(places_.size() == 1 ? "two more places" : "one more place") +
               ", Escape to begin again";
    }

private:
    ThreePlaces of_;
    std::vector<glm::dvec3> places_;
    glm::dvec2 pressed_at_{0.0};
    render::Pick under_{};
};

} // namespace

std::unique_ptr<Tool> make_slice_points_tool() {
    // The next click is about the slice.
    return std::make_unique<ThreePlacesTool>(
        ThreePlaces{{"slice-through"}, kObliqueColour, "the oblique slice goes through them", true, false});
}

std::unique_ptr<Tool> make_points_tool() {
    return std::make_unique<ThreePlacesTool>(
        ThreePlaces{{"resect", "points"}, kPlaneColour, "the plane through them divides the organ", false, true});
}

} // namespace ramus::app
