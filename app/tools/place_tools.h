// The tools that put something at a place of a vessel: cuts and lesions. Measurements: app/tools/measure_tool.h.
#pragma once

#include "app/tools/tool.h"

#include <array>
#include <optional>
#include <utility>

namespace ramus::app {

// CutTool: cuts the branch under the pointer across, at the point of its centerline nearest to the pointer's on
// the surface, which a ring shows before the click.
class CutTool final : public Tool {
public:
    void press(const Pointing& pointing) override;
    void move(const Pointing& pointing) override;
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override { return "Click a vessel to cut it there"; }

private:
    render::Pick under_;
};

// LesionTool: places spherical lesions. A press puts the centre on the surface under the pointer, or, beside the
// vessels, at the depth of the focal point; dragging sizes it, and a click alone gives it the usual size, less in a
// small tree. A press on a lesion takes hold of that one: near its outline it is sized, elsewhere moved across the
// view.
class LesionTool final : public Tool {
public:
    static constexpr double kLeastOfUsual = 0.05;

    void press(const Pointing& pointing) override;
    void move(const Pointing& pointing) override;
    void release(const Pointing& pointing) override;
    bool escape() override { return std::exchange(held_, std::nullopt).has_value(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override;

private:
    struct Held {
        std::array<double, 4> sphere{}; // as it is now
        std::array<double, 4> before{};
        std::optional<std::size_t> index; // of a lesion that was there
        bool sizing = true;
        bool moved = false;
        glm::dvec2 pressed_at{0.0};
        double depth_mm = 0.0; // of its centre
        double usual_mm = 0.0; // radius in this tree
    };
    std::optional<Held> held_;
};

} // namespace ramus::app
