// Pace: which quality a picture is drawn in, so that a window answers at once however slow its rasteriser is. While
// somebody drags, and where full frames would take long, what changes is drawn quickly first, and fully as soon as it
// rests. It learns from how long full frames take. No GL.
#pragma once

#include "render/scene/frame.h"

#include <memory>
#include <vector>

namespace ramus::app {

class Pace {
public:
    static constexpr double kRestSeconds = 0.12;
    static constexpr double kSlowSeconds = 0.1; // a full frame that takes longer waits for the view to rest

    static constexpr double kProvisionalSeconds = 2.0; // what something better is coming for rests later

    // `software`: there is no graphics card, so full frames count as slow until one has been drawn.
    explicit Pace(bool software) : software_(software) {}

    // The quality to draw `frame` in at `now`. `moving`: a drag goes on; `provisional`: a better mesh is being made.
    [[nodiscard]] render::Quality quality(const render::Frame& frame, bool moving, bool provisional, double now);
    // Whether `frame` would take long in full quality.
    [[nodiscard]] bool slow(const render::Frame& frame) const;
    // What a frame took whose triangles were drawn.
    void drawn(const render::Frame& frame, double seconds);
    // When a frame that was drawn quickly is due to be drawn fully.
    [[nodiscard]] double rests_at() const { return changed_at_ + (provisional_ ? kProvisionalSeconds : kRestSeconds); }

private:
    // What triangles are drawn again for.
    struct View {
        std::shared_ptr<const render::PagedMesh> mesh;
        render::Camera camera;
        glm::ivec2 size{0};
        std::vector<render::BranchState> states;
        std::shared_ptr<const render::Centerlines> awaited; // of the surface that is not there yet
        float awaited_width = 0.0F;
        bool operator==(const View&) const = default;
    };

    bool software_;
    double full_seconds_ = 0.0; // of the last full frame, 0: there was none
    double full_triangles_ = 1.0;
    bool provisional_ = false;
    double changed_at_ = -1e9;
    View last_;
};

} // namespace ramus::app
