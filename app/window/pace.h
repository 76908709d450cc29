// Pace: chooses the quality of the next picture so that the window responds quickly with any rasteriser. During drags,
// and where full frames are slow, changes are drawn in interactive quality first, and fully once the view rests. Learns
// the speed from full frames. No GL.
#pragma once

#include "render/scene/frame.h"

#include <memory>
#include <vector>

namespace ramus::app {

class Pace {
public:
    static constexpr double kRestSeconds = 0.12;
    static constexpr double kSlowSeconds = 0.1; // slower full frames wait for the view to rest

    static constexpr double kProvisionalSeconds = 2.0; // provisional pictures rest later

    // `software`: OpenGL is a software rasteriser, so full frames are assumed slow until one was drawn.
    explicit Pace(bool software) : software_(software) {}

    // The quality for `frame` at `now`. `moving`: during a drag; `provisional`: a better mesh is being made. Seconds.
    [[nodiscard]] render::Quality quality(const render::Frame& frame, bool moving, bool provisional, double now);
    // Whether `frame` would be slow in full quality.
    [[nodiscard]] bool slow(const render::Frame& frame) const;
    // Reports the time of a frame whose triangles were drawn.
    void drawn(const render::Frame& frame, double seconds);
    // When a frame in interactive quality is to be drawn fully.
    [[nodiscard]] double rests_at() const { return changed_at_ + (provisional_ ? kProvisionalSeconds : kRestSeconds); }

private:
    // The inputs whose change makes triangles be drawn again.
    struct View {
        std::shared_ptr<const render::PagedMesh> mesh;
        render::Camera camera;
        glm::ivec2 size{0};
        std::vector<tree::BranchState> states;
        std::shared_ptr<const render::Centerlines> awaited; // of the surface in progress
        float awaited_width = 0.0F;
        bool operator==(const View&) const = default;
    };

    bool software_;
    double full_seconds_ = 0.0; // of the last full frame; 0: none yet
    double full_triangles_ = 1.0;
    bool provisional_ = false;
    double changed_at_ = -1e9;
    View last_;
};

} // namespace ramus::app
