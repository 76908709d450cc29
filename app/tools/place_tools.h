// Tools that place cuts and lesions. Measurements: app/tools/measure_tool.h.
#pragma once

#include "app/tools/tool.h"

#include <array>
#include <optional>
#include <utility>

namespace ramus::app {

// CutTool: cuts the branch under the pointer, at the centerline point nearest to the surface point under the pointer; a
// ring previews the cut. A press on the ring of a cut grabs it, and it follows the pointer along its branch.
class CutTool final : public Tool {
public:
    void press(const Pointing& pointing) override;
    void move(const Pointing& pointing) override;
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    void release(const Pointing&) override { held_.reset(); }
    bool escape() override;
    [[nodiscard]] bool busy() const override { return held_.has_value(); }
    [[nodiscard]] bool changes_while_held() const override { return held_.has_value(); }
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kBoth; }
    [[nodiscard]] std::string hint() const override {
        return held_ ? "Drag the cut along its branch, let go to keep it, Escape to leave it"
                     : "Click a vessel to cut it there; drag a cut along its branch";
    }

private:
    struct Held {
        std::size_t cut = 0; // index
        int branch = 0;
        double before = 0.0, now = 0.0; // fractions of the branch
    };
    void send(double fraction);

    render::Pick under_;
    std::optional<Held> held_;
};

// LesionTool: places spherical lesions. A press sets the centre on the surface under the pointer or in the slice, or
// at the depth of the focal point if there is neither. Dragging sets the radius; a click gives the default radius,
// which is smaller for small trees. A press on an existing lesion grabs it: near its outline it is resized, elsewhere
// moved parallel to the view.
class LesionTool final : public Tool {
public:
    static constexpr double kLeastOfUsual = 0.05;

    void press(const Pointing& pointing) override;
    void move(const Pointing& pointing) override;
    void release(const Pointing& pointing) override;
    bool escape() override { return std::exchange(held_, std::nullopt).has_value(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kBoth; }
    [[nodiscard]] std::string hint() const override;

private:
    struct Held {
        std::array<double, 4> sphere{}; // current value
        std::array<double, 4> before{};
        std::optional<std::size_t> index; // of an existing lesion
        bool sizing = true;
        bool moved = false;
        glm::dvec2 pressed_at{0.0};
        double depth_mm = 0.0; // of its centre
        double usual_mm = 0.0; // default radius for this tree
    };
    std::optional<Held> held_;
};

} // namespace ramus::app
