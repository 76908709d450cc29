#include "core/mesh/surface.h"
#include "core/tree/prune.h"
#include "core/tree/smooth.h"

namespace ramus::mesh {

PreparedTree prepare_tree(const tree::VesselTree& source, const SurfaceOptions& options) {
    tree::PrunedTree pruned = tree::prune(source, options.prune_ratio);
    return {tree::smooth(std::move(pruned.tree), options.smooth_passes), std::move(pruned.segment_source)};
}

} // namespace ramus::mesh
