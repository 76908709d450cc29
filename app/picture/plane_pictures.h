// PlanePictures: the slices that a session shows among the vessels, as planes of a frame. Who draws them paints their
// pictures, which are kept, so that only what changed is sampled again. Not thread-safe.
#pragma once

#include "app/assets/assets.h"
#include "app/session/session.h"
#include "render/scene/scan_plane.h"
#include "render/slice/slice_view.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::app {

class PlanePictures {
public:
    // The slices that are shown in the picture, each covering the first scan; without a scan only their outlines.
    [[nodiscard]] std::vector<render::ScanPlane> planes(const Session& session, const Assets& assets);

private:
    class Painter;
    struct Kept {
        render::SliceView of;
        std::shared_ptr<Painter> painter;
        std::shared_ptr<const render::LatePicture> picture;
    };
    std::array<std::optional<Kept>, 4> kept_; // by slice::Direction
};

} // namespace ramus::app
