// The section of what a frame shows with a plane: outlines of vessels in the colours of the picture, of context and of
// lesions, the margins around lesions if the picture has their bands, and the places where centerlines cross. Hidden
// branches are left out, defocused ones are grey and thin.
#pragma once

#include "core/measure/mesh_distance.h"
#include "core/slice/section.h"
#include "render/scene/frame.h"

#include <glm/vec3.hpp>
#include <list>
#include <memory>
#include <vector>

namespace ramus::render {

// The loops in which a plane cuts the surface. Vertex numbers are those of the mesh.
[[nodiscard]] std::vector<slice::Loop> section_of(const PagedMesh& mesh, const slice::Plane& plane);
// The branch of a point of such a loop.
[[nodiscard]] inline int branch_at(const PagedMesh& mesh, const slice::EdgePoint& point) {
    return mesh.vertex(point.nearer()).branch;
}

// A loop with the branch of each point. The piece from a point to the next belongs to the point's branch.
struct VesselLoop {
    std::vector<glm::dvec3> points; // mm
    std::vector<int> branches;
    bool closed = true;
};

struct SectionLine {
    std::vector<glm::dvec3> points; // mm
    bool closed = true;
    glm::vec3 colour{1.0F}; // sRGB
    float width = 1.5F;     // points
    float opacity = 1.0F;
    float fill = 0.0F; // opacity of the area inside
    int group = -1;    // lines of one group are filled together, so that holes stay empty; -1: not filled
};

struct AxisCrossing {
    glm::dvec3 at{0.0}; // mm
    int branch = kNoBranch;
    glm::vec3 colour{1.0F};
};

struct FrameSection {
    std::vector<SectionLine> lines; // in the order of drawing
    std::vector<AxisCrossing> crossings;
    std::vector<VesselLoop> vessels; // whose outlines are among the lines
};

// The vessel at a pixel of a slice: that of the nearest outline within `reach` pixels, or around the pixel. kNoBranch:
// none.
[[nodiscard]] int branch_at(const FrameSection& section, const slice::PixelGrid& grid, const glm::dvec2& pixel,
                            double reach);

// Keeps the index of each mesh for the next sections. Not thread-safe.
class FrameCutter {
public:
    [[nodiscard]] FrameSection section(const Frame& frame, const slice::Plane& plane);

private:
    struct Index {
        std::shared_ptr<const mesh::TriangleMesh> mesh;
        std::unique_ptr<slice::MeshBlocks> blocks;
        std::unique_ptr<measure::MeshDistance> distance; // null: not asked for yet
        bool used = false;
    };
    Index& index_of(const std::shared_ptr<const mesh::TriangleMesh>& mesh);
    [[nodiscard]] std::vector<slice::Loop> loops_of(const std::shared_ptr<const mesh::TriangleMesh>& mesh,
                                                    const slice::Plane& plane);
    void add_context(const Frame& frame, const slice::Plane& plane, FrameSection& section);
    void add_lesions(const Frame& frame, const slice::Plane& plane, FrameSection& section);
    void add_margins(const Frame& frame, const slice::Plane& plane, FrameSection& section);

    std::list<Index> indices_;
};

} // namespace ramus::render
