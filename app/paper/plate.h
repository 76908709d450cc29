// Plate: a figure's picture, made of panels side by side on white, each with an inset if wanted: the same vessels
// magnified or from another side. Drawn on the processor, without a display.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "render/gl/gl_context.h"
#include "render/image/image.h"
#include "render/renderer/renderer.h"
#include "render/scene/frame.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app::paper {

using Paged = std::shared_ptr<const render::PagedMesh>;

// Where an inset or a close-up looks the same way as its panel, a rectangle in the panel shows what it magnifies.
struct Panel {
    render::Frame frame;                   // its caption stands above the picture, not in it
    std::optional<render::Frame> inset{};  // in the lower right corner
    std::optional<std::size_t> close_up{}; // the panel of the plate that magnifies a part of this one
};

struct Plate {
    std::size_t columns = 1;
    std::vector<Panel> panels{}; // row by row, all of one size
};

// Text and scale bars of all panels: pixels per point. Pages show plates at less than their size.
inline constexpr float kPlateRatio = 1.5F;

// Surface, camera and caption on white, with a scale bar.
[[nodiscard]] render::Frame frame_of(Paged mesh, const render::Camera& camera, glm::ivec2 size,
                                     const std::string& caption);

// A parallel projection from the front that shows all of the surfaces above the scale bar, turned by angles in degrees.
// `left`, `right`: shares of the width that are kept free, for a legend and for an inset.
struct Looking {
    double azimuth = 0.0, elevation = 0.0, left = 0.0, right = 0.0;
};
[[nodiscard]] render::Camera camera_on(const std::vector<Paged>& surfaces, glm::ivec2 size,
                                       const Looking& looking = {});
// The same direction, `height_mm` high around `at`.
[[nodiscard]] render::Camera magnified(render::Camera camera, const glm::dvec3& at, double height_mm);

class Artist {
public:
    [[nodiscard]] static Result<std::unique_ptr<Artist>> create();

    [[nodiscard]] Result<render::Image> draw(const Plate& plate, Job& job);
    [[nodiscard]] render::Renderer& renderer() { return *renderer_; }

private:
    Artist() = default;
    [[nodiscard]] Result<render::Image> draw(const render::Frame& frame);
    [[nodiscard]] Result<render::Image> draw(const Panel& panel, const Plate& plate);

    std::unique_ptr<render::GlContext> context_; // lives longest
    std::unique_ptr<render::Renderer> renderer_;
};

} // namespace ramus::app::paper
