// Draws the pictures of a validated surface: the surface, the surface with its findings marked, coloured by the
// distance from other surfaces, and a close-up of each finding. Draws on the processor, without a display.
#pragma once

#include "app/reports/validation/data_set.h"
#include "core/base/error.h"
#include "core/mesh/surface_options.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"
#include "render/gl/gl_context.h"
#include "render/renderer/renderer.h"

#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

// A validated surface with what its pictures show.
struct PaintedSurface {
    mesh::TriangleMesh mesh; // may lack branches and radii
    const tree::VesselTree& tree;
    mesh::SurfaceOptions options;               // of the surface
    std::vector<float> to_cones_mm, to_mask_mm; // distances by vertex, mm; empty: not measured
};

class ValidationPainter {
public:
    // `few`: there are only few data sets, so pictures may take more time and bytes.
    [[nodiscard]] static Result<std::unique_ptr<ValidationPainter>> create(bool few);

    // Draws all pictures of a data set and adds them to `set`. Places have the same codes as in the tables of the
    // report.
    [[nodiscard]] Result<void> paint(const PaintedSurface& surface, ValidatedDataSet& set);

private:
    ValidationPainter() = default;
    [[nodiscard]] Result<ReportPicture> draw(const render::Frame& frame, std::string caption);
    [[nodiscard]] Result<void> paint_whole(const render::Frame& frame, const PaintedSurface& surface,
                                           ValidatedDataSet& set);
    [[nodiscard]] Result<void> paint_deviations(render::Frame frame, const PaintedSurface& surface,
                                                ValidatedDataSet& set);
    [[nodiscard]] Result<void> paint_places(render::Frame frame, const PaintedSurface& surface, ValidatedDataSet& set);

    std::unique_ptr<render::GlContext> context_; // lives longest
    std::unique_ptr<render::Renderer> renderer_;
    bool few_ = true;
};

} // namespace ramus::app
