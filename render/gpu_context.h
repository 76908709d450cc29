// GpuContext: context meshes on the graphics card. A mesh is sent once and stays as long as the frame names it, as
// triangles that share vertices or, for lines, as triangles of their own.
#pragma once

#include "render/bounds.h"
#include "render/gl_objects.h"
#include "render/scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ramus::render {

class GpuContext {
public:
    // Sends what is new and lets go of what is no longer there. What is not shown is not sent.
    void follow(const std::vector<ContextMesh>& context);

    struct Shape {
        VertexArray vertex_array;
        Buffer vertices, triangles;
        GLsizei corners = 0;
        Box bounds; // mm; positions are relative to its centre
        // Every edge is met once from either side, and triangles face outward: backs are never seen.
        bool closed = false;
        bool lines = false;
        std::shared_ptr<const mesh::TriangleMesh> of;

        void draw() const; // with a context program in use
    };
    // Of one that is shown and was given to follow(): the preview, if there is one and that will do.
    [[nodiscard]] const Shape* shape(const ContextMesh& mesh, bool preview_will_do) const;
    [[nodiscard]] Box bounds(const std::vector<ContextMesh>& context) const; // of all that are shown; mm

private:
    std::vector<Shape> shapes_;
};

} // namespace ramus::render
