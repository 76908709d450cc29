// Pictures of a surface that was held against its tree: as it is, with what was found marked, coloured by how far it is
// from other surfaces, and close to each found place. Drawn on the processor, without a display.
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

// What is painted.
struct PaintedSurface {
    mesh::TriangleMesh mesh; // may lack branches and radii
    const tree::VesselTree& tree;
    mesh::SurfaceOptions options;               // how the tree is taken
    std::vector<float> to_cones_mm, to_mask_mm; // by vertex; empty: nothing is known
};

class ValidationPainter {
public:
    // `few`: there are few data sets, whose pictures are worth more time and bytes.
    [[nodiscard]] static Result<std::unique_ptr<ValidationPainter>> create(bool few);

    // Gives the data set its pictures. The codes of places are those of the report's tables.
    [[nodiscard]] Result<void> paint(PaintedSurface surface, ValidatedDataSet& set);

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
