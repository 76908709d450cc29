#include "core/mesh/surface.h"
#include "core/tree/prune.h"
#include "core/tree/smooth.h"

namespace ramus::mesh {

PreparedTree prepare_tree(const tree::VesselTree& source, const SurfaceOptions& options) {
    PreparedTree prepared = tree::prune(source, options.prune_ratio);
    prepared.tree = tree::smooth(std::move(prepared.tree), options.smooth_passes);
    return prepared;
}

} // namespace ramus::mesh
