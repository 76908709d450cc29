// GpuSolids: spheres and closed meshes on the graphics card, for lesions. A mesh is sent once and stays as long as the
// frame names it. Ids are as in the geometry pass: those of solids begin at kFirstSolid, beyond every branch.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "render/bounds.h"
#include "render/gl_objects.h"

#include <memory>
#include <vector>

namespace ramus::render {

inline constexpr int kFirstSolid = 0x40000000;
inline constexpr int kFirstContext = 0x60000000; // of context meshes (render/gpu_context.h), beyond every lesion

class GpuSolids {
public:
    // Sends what is new and lets go of what is no longer there.
    void follow(const std::vector<std::shared_ptr<const mesh::TriangleMesh>>& meshes);
    [[nodiscard]] Box bounds(const mesh::TriangleMesh& mesh) const; // of one that was given to follow(); mm

    // With the geometry program in use: a unit sphere about the origin; a mesh relative to the centre of its bounds.
    void draw_sphere(int id);
    void draw(const mesh::TriangleMesh& mesh, int id) const;

private:
    struct Solid {
        VertexArray vertex_array;
        Buffer vertices, triangles;
        GLsizei indices = 0;
        Box bounds;
        std::shared_ptr<const mesh::TriangleMesh> of;
    };
    [[nodiscard]] static Solid make(const mesh::TriangleMesh& mesh);
    static void draw(const Solid& solid, int id);
    std::vector<Solid> solids_;
    Solid sphere_;
};

} // namespace ramus::render
