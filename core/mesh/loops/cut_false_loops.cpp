#include "core/mesh/loops/cut_false_loops.h"

#include "core/mesh/connectivity.h"
#include "core/mesh/loops/axes.h"
#include "core/mesh/loops/false_loops.h"
#include "core/mesh/loops/loop_patch.h"
#include "core/mesh/loops/surface_parts.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh {

namespace {

constexpr std::size_t kMostAsWhole = 4'000'000; // triangles times loops; a search takes 1.2 us for each triangle
constexpr double kBytesPerTriangle = 140.0;     // memory of a search (measured: 127), for any number of loops

// The result for one part; without a patch if nothing was cut.
struct LookedAt {
    std::optional<LoopPatch> patch;
    std::size_t cut = 0;
    double lacked_bytes = 0.0;
};

struct LoopCutter {
    const Axes& axes;
    bool fill_holes;
    double memory_bytes;
};

// Cuts parts in parallel. They do not depend on each other, so the result is the same for any number of threads.
CutLoops cut_in_parts(TriangleMesh& mesh, std::span<const SurfacePart> parts, const LoopCutter& cutter,
                      std::size_t most, Job& job) {
    std::vector<const SurfacePart*> with_loops; // few
    for (const SurfacePart& part : parts)
        if (part.has_loops) with_loops.push_back(&part);
    std::vector<LookedAt> looked(with_loops.size());
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, looked.size(), [&](std::size_t n) {
        const SurfacePart& part = *with_loops[n];
        if (job.cancelled()) return;
        LookedAt& one = looked[n];
        if (const double needed = kBytesPerTriangle * static_cast<double>(part.triangles.size());
            needed > cutter.memory_bytes) {
            one.lacked_bytes = needed;
            return;
        }
        one.patch.emplace(mesh, part);
        const std::int64_t loops = connectivity_of(one.patch->closed()).loops;
        if (loops > 0) {
            FalseLoops found(one.patch->closed(), cutter.axes, cutter.fill_holes, one.patch->barred());
            const float so_far = static_cast<float>(done) / static_cast<float>(looked.size());
            Job step(job, so_far, so_far);
            one.cut = found.cut(std::min(most, static_cast<std::size_t>(loops)), step);
        }
        if (one.cut == 0) one.patch.reset();
        job.report(static_cast<float>(++done) / static_cast<float>(looked.size()));
    });
    CutLoops all;
    if (job.cancelled()) return all;
    for (const LookedAt& one : looked) {
        all.lacked_bytes = std::max(all.lacked_bytes, one.lacked_bytes);
        if (one.cut == 0 || all.cut + one.cut > most) continue;
        one.patch->put_back(mesh);
        all.cut += one.cut;
    }
    return all;
}

// The triangles of the parts that loops pass through.
LargeArray<std::uint32_t> on_loops(const SurfaceParts& all) {
    LargeArray<std::uint32_t> found;
    for (const SurfacePart& part : all.parts())
        if (part.has_loops) found.insert(found.end(), part.triangles.begin(), part.triangles.end());
    return found;
}

} // namespace

CutLoops cut_false_loops(TriangleMesh& mesh, const tree::PreparedTree& tree, const SurfaceParts& at_walls,
                         double memory_bytes, Job& job) {
    const std::int64_t asked = connectivity_of(tree.tree).loops;
    const Axes axes(tree.tree);
    const LoopCutter cutter{axes, asked == 0, memory_bytes};
    std::int64_t others = at_walls.of_surface().loops - asked;
    CutLoops all;
    std::optional<TriangleBoxes> boxes; // of the surface as it is now
    const auto look = [&](float begin, float end, std::span<const SurfacePart> parts) {
        Job step(job, begin, end);
        const CutLoops cut = cut_in_parts(mesh, parts, cutter, static_cast<std::size_t>(others), step);
        all.add(cut), others -= static_cast<std::int64_t>(cut.cut);
        if (cut.cut > 0) boxes.reset();
    };
    const auto divided = [&](LargeArray<std::uint32_t> near, Rest rest = Rest::kConnections) {
        if (!boxes) boxes.emplace(mesh);
        return SurfaceParts(mesh, *boxes, std::move(near), rest);
    };
    const auto look_at = [&](float begin, float end, LargeArray<std::uint32_t> triangles) {
        if (!triangles.empty()) look(begin, end, divided(std::move(triangles)).parts());
    };
    const auto look_around = [&](float begin, float end, const SurfaceParts& near) {
        look_at(begin, end, triangles_around(mesh, *boxes, on_loops(near)));
    };
    if (others > 0) look(0.0F, 0.3F, at_walls.parts());
    if (others > 0) { // caps, whose triangles come later, connect nothing
        const LargeArray<std::uint32_t> between = triangles_between_branches(mesh);
        const LargeArray<std::uint32_t> foreign = foreign_triangles(mesh, tree, between);
        look_around(0.3F, 0.5F, divided(foreign));
        if (others > 0) {
            const SurfaceParts joints = divided(between, Rest::kLoops);
            look_around(0.5F, 0.6F, joints);
            // Loops within one branch, which bends until it touches itself.
            if (others > 0) look_at(0.6F, 0.7F, joints.rest_with_loops());
        }
        if (others > 0 && static_cast<std::size_t>(others) * mesh.triangles.size() <= kMostAsWhole) {
            LargeArray<std::uint32_t> triangles(mesh.triangles.size(), mesh.memory());
            std::iota(triangles.begin(), triangles.end(), 0U);
            const SurfacePart whole{triangles, {}, true};
            look(0.7F, 1.0F, std::span(&whole, 1));
        }
        if (others > 0)
            for (const std::uint32_t n : on_loops(divided(foreign)))
                all.left.push_back(mesh.positions[mesh.triangles[n].x]);
    }
    job.report(1.0F);
    return all;
}

} // namespace ramus::mesh
