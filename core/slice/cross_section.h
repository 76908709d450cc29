// Cross-sections of a vessel: the lumen around the axis in the plane across a path, from the loops of a surface or of a
// mask (mask_loops.h), with its figures; and the pixels of the scan's picture there.
//
// The lumen is the innermost loop that encloses the axis, with its holes. There is none where no loop encloses the
// axis, where the axis is in a hole, and where loops are clockwise, so that the surface has its inside out. On a
// surface with holes, an open polyline counts as closed by a straight line if no closed loop encloses the axis; such a
// lumen is not `closed`. Figures are exact for the loops. Units: mm, mm2.
//
//     const MeshBlocks blocks(mesh);
//     const auto loops = [&](const Plane& plane) { return section(blocks, plane); };
//     const std::vector<std::optional<Lumen>> lumens = lumens_along(path.samples, loops, OtherBranches(tree, path));
#pragma once

#include "core/base/bounds.h"
#include "core/slice/plane_shape.h"
#include "core/slice/section.h"
#include "core/slice/vessel_path.h"

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ramus::slice {

struct Lumen {
    std::vector<Loop> loops; // the outer loop, then its holes
    bool closed = true;      // the outer loop
    ShapeFigures figures;
    // Branches that are not on the path, but whose centerline goes through the lumen, ascending: at a fork the section
    // is wider than the vessel.
    std::vector<int> shared_with;
};

// The lumen in `plane` around `at`, a point of the plane.
[[nodiscard]] std::optional<Lumen> lumen_around(std::vector<Loop> loops, const Plane& plane, const glm::dvec3& at);

// The centerlines of branches that are not on a path. Refers to the tree.
class OtherBranches {
public:
    OtherBranches(const tree::VesselTree& tree, const VesselPath& path);
    // Those that go through a lumen.
    [[nodiscard]] std::vector<int> through(const Lumen& lumen, const Plane& plane) const;

private:
    const tree::VesselTree* tree_;
    std::vector<std::pair<int, Bounds<glm::dvec3>>> boxes_;
};

// The loops of a surface in a plane, whatever holds the surface. Called from several threads.
using LoopsOfPlane = std::function<std::vector<Loop>(const Plane&)>;

// The lumen at each sample. The result does not depend on threads.
[[nodiscard]] std::vector<std::optional<Lumen>> lumens_along(std::span<const PathSample> samples,
                                                             const LoopsOfPlane& loops, const OtherBranches& others);

// The pixels of a square picture across a path, about the axis. Its axes are those of the sample, so that pictures of
// neighbouring samples do not turn against each other.
[[nodiscard]] PixelGrid cross_grid(const PathSample& sample, double mm_per_pixel, int pixels);

} // namespace ramus::slice
