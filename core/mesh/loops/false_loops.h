// FalseLoops: cuts those of one surface, as a whole.
#pragma once

#include "core/base/job.h"
#include "core/mesh/loops/axes.h"
#include "core/mesh/loops/surface_loops.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <vector>

namespace ramus::mesh {

class FalseLoops {
public:
    // `axes`: of the vessels; `barred`: by vertex, not 0: no line goes there; those that come later are not. All must
    // outlive it.
    FalseLoops(TriangleMesh& mesh, const Axes& axes, bool fill_holes, std::span<const std::uint8_t> barred)
        : mesh_(mesh), axes_(axes), fill_holes_(fill_holes), barred_(barred) {}

    // Cuts the surface along the best lines, at most so many, and as long as that takes no more than seconds. Each cut
    // takes one loop away. Returns how many; fewer if cancelled.
    [[nodiscard]] std::size_t cut(std::size_t most, Job& job);

private:
    [[nodiscard]] std::vector<SurfaceLoop> best_apart(std::size_t most, Job& job);
    [[nodiscard]] SurfaceLoop best(const SurfaceGraph& graph, const SurfaceLoops& loops, Job& job);
    void look(const SurfaceLoops& loops, std::uint32_t vertex);
    [[nodiscard]] bool goes_around_vessel(const SurfaceLoop& loop);
    void forget(const SurfaceLoop& loop);

    TriangleMesh& mesh_;
    const Axes& axes_;
    bool fill_holes_;
    std::span<const std::uint8_t> barred_;
    IndependentKinds found_; // kinds of lines, as the surface is now
    SurfaceLoop best_;
    double cost_ = 0.0;
    std::map<std::vector<std::uint32_t>, bool> around_vessel_; // by a line's vertices
    std::size_t steps_ = 0;                                    // of all searches
};

} // namespace ramus::mesh
