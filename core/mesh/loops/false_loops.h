// FalseLoops: finds and cuts the false loops of one closed surface, without dividing it into parts.
#pragma once

#include "core/base/job.h"
#include "core/mesh/loops/axes.h"
#include "core/mesh/loops/closed_lines.h"
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
    // `axes`: the axes of the vessels. `barred`: by vertex; not 0: no line may pass through the vertex. Vertices added
    // by cuts are not barred. All references must outlive the object.
    FalseLoops(TriangleMesh& mesh, const Axes& axes, bool fill_holes, std::span<const std::uint8_t> barred)
        : mesh_(mesh), axes_(axes), fill_holes_(fill_holes), barred_(barred) {}

    // Cuts the surface along the best lines, at most `most`; each cut removes one loop. Stops when a limit on the work
    // is reached (some seconds), or if cancelled. Returns the number of cuts.
    [[nodiscard]] std::size_t cut(std::size_t most, Job& job);

private:
    [[nodiscard]] std::vector<ClosedLine> best_apart(std::size_t most, Job& job);
    [[nodiscard]] ClosedLine best(const SurfaceGraph& graph, const ClosedLines& closed_lines, Job& job);
    void look(const ClosedLines& closed_lines, std::uint32_t vertex);
    [[nodiscard]] bool goes_around_vessel(const ClosedLine& line);
    void forget(const ClosedLine& line);

    TriangleMesh& mesh_;
    const Axes& axes_;
    bool fill_holes_;
    std::span<const std::uint8_t> barred_;
    IndependentClasses found_; // homology classes of the lines found on the current surface
    ClosedLine best_;
    double cost_ = 0.0;
    std::map<std::vector<std::uint32_t>, bool> around_vessel_; // cache of goes_around_vessel(), by a line's vertices
    std::size_t steps_ = 0;                                    // work of all searches
};

} // namespace ramus::mesh
