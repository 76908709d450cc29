// Pictures of a surface that was held against its tree: as it is, and with what was found marked. Drawn on the
// processor, without a display.
#pragma once

#include "app/reports/validation/data_set.h"
#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"
#include "render/gl/gl_context.h"
#include "render/renderer/renderer.h"

#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

class ValidationPainter {
public:
    // `few`: there are few data sets, whose pictures are worth more time and bytes.
    [[nodiscard]] static Result<std::unique_ptr<ValidationPainter>> create(bool few);

    // The surface may lack branches and radii. The codes of places are those of the report's tables.
    [[nodiscard]] Result<std::vector<ReportPicture>> pictures(mesh::TriangleMesh surface, const tree::VesselTree& tree,
                                                              const ValidatedDataSet& set);

private:
    ValidationPainter() = default;
    [[nodiscard]] Result<ReportPicture> draw(const render::Frame& frame, std::string caption);

    std::unique_ptr<render::GlContext> context_; // lives longest
    std::unique_ptr<render::Renderer> renderer_;
    bool few_ = true;
};

} // namespace ramus::app
