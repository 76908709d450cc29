#include "core/mesh/polygonize/polygonize.h"

#include "core/mesh/polygonize/polygonizer.h"

namespace ramus::mesh {

Result<TriangleMesh> polygonize(const field::ConvolutionField& field, const PolygonizeOptions& options, Job& job,
                                PolygonizeStatistics* statistics) {
    if (field.segments().empty()) return fail("the tree has no segments", {}, "nothing to make a surface of");
    if (field.present().empty()) return fail("every branch is hidden", {}, "nothing to make a surface of");
    Polygonizer polygonizer(Polygonizer::Purpose::kOnce);
    if (auto made = polygonizer.make(field, options, job); !made) return tl::unexpected(made.error());
    if (statistics != nullptr) *statistics = polygonizer.statistics();
    return polygonizer.take_mesh();
}

} // namespace ramus::mesh
