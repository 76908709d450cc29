#include "app/tools/slice_points_tool.h"

#include "app/tools/spelling.h"

#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

const glm::vec4 kObliqueColour{0.72F, 0.56F, 0.98F, 1.0F};
constexpr double kPlaceRadius = 4.5;    // points
constexpr double kLargestOfClick = 8.0; // points: a pointer that moved farther did not click
constexpr std::size_t kPlacesOfSlice = 3;

bool is_place(const Pointing& pointing, const render::Pick& pick) {
    return pick.branch != render::kNoBranch || pointing.on_scan(pick);
}

class SlicePointsTool final : public Tool {
public:
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kBoth; }
    void press(const Pointing& pointing) override { pressed_at_ = pointing.at; }
    void move(const Pointing& pointing) override { under_ = pointing.pick(); }
    void release(const Pointing& pointing) override {
        const render::Pick& pick = pointing.pick();
        const bool clicked = glm::distance(pointing.at, pressed_at_) < kLargestOfClick * pointing.pixel_ratio;
        if (!clicked || !is_place(pointing, pick)) return;
        places_.push_back(pick.position);
        if (places_.size() < kPlacesOfSlice) return;
        CommandLine line{"slice-through"};
        for (const glm::dvec3& place : std::exchange(places_, {})) line.push_back(finely_spelled(place));
        command(std::move(line));
        command({"tool", "navigate"}); // the next click is about the slice
    }
    bool escape() override { return !std::exchange(places_, {}).empty(); }
    [[nodiscard]] bool busy() const override { return !places_.empty(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override {
        ToolDrawing drawing;
        std::vector<glm::dvec2> corners;
        const auto mark = [&](const glm::dvec3& place, bool set) {
            const auto at = render::project(pointing.camera(), pointing.size, place);
            if (!at || !pointing.shows(place)) return;
            corners.emplace_back(*at);
            drawing.circles.push_back(
                {glm::dvec2(*at), kPlaceRadius * pointing.pixel_ratio, kObliqueColour, 1.5F, set});
        };
        for (const glm::dvec3& place : places_) mark(place, true);
        if (is_place(pointing, under_)) mark(under_.position, false);
        if (corners.size() == kPlacesOfSlice) corners.push_back(corners.front());
        if (corners.size() > 1) drawing.lines.push_back({corners, kObliqueColour, 1.5F, false});
        return drawing;
    }
    [[nodiscard]] std::string hint() const override {
        if (places_.empty()) return "Click three places on vessels or slices: the oblique slice goes through them";
        return "Click " + std::string(places_.size() == 1 ? "two more places" : "one more place") +
               ", Escape to begin again";
    }

private:
    std::vector<glm::dvec3> places_;
    glm::dvec2 pressed_at_{0.0};
    render::Pick under_{};
};

} // namespace

std::unique_ptr<Tool> make_slice_points_tool() { return std::make_unique<SlicePointsTool>(); }

} // namespace ramus::app
