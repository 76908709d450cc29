// MeasureTool: distances between points of the surface, paths along vessels, diameters, angles between three places.
// What was clicked is what is measured: a distance goes from point to point of the surface, of vessels or of lesions,
// the others from foot to foot on the centerlines. A lesion that is clicked with Shift is meant as a whole: the
// distance is the shortest from its surface to the wall of the branch that is the other end. The value is shown before
// the last click. Ends of what was measured before are handles, of any kind of measurement: a drag moves one, with the
// value of each place on the way, and is one command when it is let go.
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
    [[nodiscard]] bool takes(const Pointing& pointing, const render::Pick& pick) const; // it can be an end
    [[nodiscard]] Measurement measurement_of(const Pointing& pointing, const std::vector<render::Pick>& picks) const;
    // What is held, unless it was changed meanwhile: undone, say, by a key.
    [[nodiscard]] const Held* held(const Pointing& pointing) const;
    void take_point(const Pointing& pointing);
    void look(const Pointing& pointing); // what would be measured by a click now

    Measurement::Kind kind_;
    std::vector<render::Pick> begun_; // clicked so far
    bool whole_ = false;              // a lesion among these, or the next one, is meant as a whole
    std::string snapped_;             // the lesion under the pointer, "lesion 1", that a click takes a place of
    glm::dvec2 pressed_at_{0.0};
    std::optional<Held> held_;
    bool over_handle_ = false;
    std::optional<Result<Measured>> live_; // of the handle that is held, or of what the next click would finish
    glm::dvec3 under_{0.0};                // the last point of the surface under the pointer
};

} // namespace ramus::app
