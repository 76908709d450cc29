// PartialView: a view that is drawn in parts, so that a window can answer in between.
#pragma once

#include "render/renderer/card.h"

#include <array>

namespace ramus::render {

class PartialView {
public:
    // Into `targets`, which with `passes` and `scene` outlive it. `moving` as for Passes::draw_view().
    PartialView(const Passes& passes, SceneOnCard& scene, ViewTargets& targets, Frame frame, std::vector<Layer> layers,
                bool moving)
        : frame_(std::move(frame)), layers_(std::move(layers)), subject_{frame_, layers_, scene.mesh(), scene},
          drawing_(passes.draw_view(subject_, targets, moving)) {}
    PartialView(const PartialView&) = delete;
    PartialView& operator=(const PartialView&) = delete;

    [[nodiscard]] const Frame& frame() const { return frame_; }
    [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
    [[nodiscard]] const Subject& subject() const { return subject_; }
    void shade_as(const Frame& frame) { frame_ = frame; } // of the same geometry

    // Draws parts, one at least, until the time is over. True: only the shading is left, and there is time for it.
    [[nodiscard]] bool draw_on(double seconds);
    [[nodiscard]] const Result<std::uint64_t>& triangles() { return drawing_.result(); } // after that

private:
    Frame frame_;
    std::vector<Layer> layers_;
    Subject subject_;
    InParts<Result<std::uint64_t>> drawing_;
    bool whole_ = false;
    std::array<Fence, 3> fences_; // behind the last parts: more would only queue up
};

} // namespace ramus::render
