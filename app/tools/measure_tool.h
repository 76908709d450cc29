// MeasureTool: measures distances between surface points, paths along vessels, diameters, and angles between three
// places. Distances connect the clicked points on the surfaces of vessels or lesions, or on slices; the other kinds
// connect feet on centerlines. A lesion clicked with Shift counts as a whole: the distance is the shortest from its
// surface to the wall of the branch at the other end. The value is shown before the last click. Ends of existing
// measurements are handles: dragging one updates the value and produces one command on release.
#pragma once

#include "app/assets/measured.h"
#include "app/tools/tool.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

class MeasureTool final : public Tool {
public:
    explicit MeasureTool(Measurement::Kind kind) : kind_(kind) {}
    void press(const Pointing& pointing) override;
    void move(const Pointing& pointing) override;
    void release(const Pointing& pointing) override;
    bool escape() override;
    [[nodiscard]] bool busy() const override { return held_.has_value() || !begun_.empty(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] Cursor cursor() const override { return over_handle_ ? Cursor::kHand : Cursor::kCross; }
    [[nodiscard]] std::string hint() const override;
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kBoth; }
    [[nodiscard]] bool points_at_branches() const override;
    [[nodiscard]] std::optional<std::size_t> moved_measurement() const override;

private:
    struct Handle {
        std::size_t measurement = 0, end = 0; // indices
    };
    struct Held {
        Handle handle;
        Measurement before, now;
        glm::dvec2 pressed_at{0.0};
        bool moved = false;
    };
    [[nodiscard]] static std::optional<Handle> handle_under(const Pointing& pointing);
    [[nodiscard]] std::size_t points_wanted() const;
    [[nodiscard]] bool takes(const Pointing& pointing, const render::Pick& pick) const; // can be an end
    [[nodiscard]] Measurement measurement_of(const Pointing& pointing, const std::vector<render::Pick>& picks) const;
    // The dragged measurement, unless something else changed it meanwhile, for example undo.
    [[nodiscard]] const Held* held(const Pointing& pointing) const;
    void take_point(const Pointing& pointing);
    void look(const Pointing& pointing); // computes what a click would measure

    Measurement::Kind kind_;
    std::vector<render::Pick> begun_; // clicks so far
    bool whole_ = false;              // a clicked or the next lesion counts as a whole
    std::string snapped_;             // the lesion under the pointer, "lesion 1", that a click would use
    glm::dvec2 pressed_at_{0.0};
    std::optional<Held> held_;
    bool over_handle_ = false;
    std::optional<Result<Measured>> live_; // of the dragged handle, or of the next click
    glm::dvec3 under_{0.0};                // the last point of the surface under the pointer
};

} // namespace ramus::app
