// The tool that sets pins: a click on the surface or on a slice sets one there, a drag moves one.
#include "app/tools/spelling.h"
#include "app/tools/tool.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>

namespace ramus::app {

namespace {

constexpr double kPinReachPoints = 11.0; // distance by which a press may miss a pin
constexpr double kPinClickPoints = 3.0;  // a pointer that moved less was only clicked
const glm::vec4 kPinColour{0.98F, 0.80F, 0.35F, 1.0F};

bool takes_pin(const Pointing& pointing, const render::Pick& pick) {
    return pick.branch != render::kNoBranch || pointing.on_scan(pick);
}

class PinTool final : public Tool {
public:
    void press(const Pointing& pointing) override {
        pressed_at_ = pointing.at;
        held_ = pin_under(pointing);
        moved_ = false;
    }

    void move(const Pointing& pointing) override {
        under_ = pointing.pick();
        if (pointing.held && glm::distance(pointing.at, pressed_at_) >= kPinClickPoints * pointing.pixel_ratio)
            moved_ = true;
    }

    void release(const Pointing& pointing) override {
        const auto held = held_pin(pointing);
        held_.reset();
        const render::Pick pick = pointing.pick();
        if (!takes_pin(pointing, pick)) return;
        if (held && moved_)
            command({"pin-move", std::to_string(*held + 1), finely_spelled(pick.position)});
        else if (held)
            command({"object-name", "pin", std::to_string(*held + 1)});
        else if (!moved_)
            command({"pin", finely_spelled(pick.position)});
    }

    bool escape() override { return std::exchange(held_, std::nullopt).has_value(); }

    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override {
        ToolDrawing drawing;
        const auto mark = [&](const glm::dvec3& place, double points) {
            if (const auto at = render::project(pointing.camera(), pointing.size, place))
                drawing.circles.push_back({glm::dvec2(*at), points * pointing.pixel_ratio, kPinColour});
        };
        if (const auto pin = held_ ? held_pin(pointing) : pin_under(pointing); pin && !moved_)
            mark(pointing.document.marks().pins[*pin].at, 14.0);
        else if (takes_pin(pointing, under_))
            mark(under_.position, 5.0);
        return drawing;
    }

    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kBoth; }
    [[nodiscard]] std::string hint() const override {
        return held_ ? "Drag to move the pin, let go to set it there, Escape to leave it"
                     : "Click a vessel or a slice to pin a text there; drag a pin to move it, click it to write";
    }

private:
    // May have been removed meanwhile, for example by undo.
    [[nodiscard]] std::optional<std::size_t> held_pin(const Pointing& pointing) const {
        return held_ && *held_ < pointing.document.marks().pins.size() ? held_ : std::nullopt;
    }
    // The nearest visible one under the pointer.
    static std::optional<std::size_t> pin_under(const Pointing& pointing) {
        const std::vector<Pin>& pins = pointing.document.marks().pins;
        std::optional<std::size_t> found;
        double nearest = kPinReachPoints * pointing.pixel_ratio;
        for (std::size_t i = 0; i < pins.size(); ++i) {
            const auto at = render::project(pointing.camera(), pointing.size, pins[i].at);
            const double distance = at ? glm::distance(glm::dvec2(*at), pointing.at) : nearest;
            if (pins[i].visible && pointing.shows(pins[i].at) && distance < nearest) nearest = distance, found = i;
        }
        return found;
    }

    render::Pick under_;
    glm::dvec2 pressed_at_{0.0};
    std::optional<std::size_t> held_; // a pin
    bool moved_ = false;
};

} // namespace

std::unique_ptr<Tool> make_pin_tool() { return std::make_unique<PinTool>(); }

} // namespace ramus::app
