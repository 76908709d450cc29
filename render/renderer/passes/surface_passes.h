// What is drawn into samples. SurfacePass: the triangles of opaque vessels, id and normal a sample. CenterlinePass: the
// same vessels as round cones where that is faster, and the centerlines inside of glass.
//
// ContextPass: what is beside the tree. Opaque context is drawn among the vessels; as fragments among the glass what is
// clear, which are context meshes, their lines, and lesions. Backs of closed meshes are not drawn; open ones are seen
// from both sides. All return the number of triangles.
#pragma once

#include "render/renderer/in_parts.h"
#include "render/renderer/scene_on_card.h"
#include "render/renderer/targets.h"

#include <functional>
#include <glm/mat4x4.hpp>
#include <vector>

namespace ramus::render {

class SurfacePass {
public:
    [[nodiscard]] Result<void> make();
    // In parts of a few milliseconds, each of which begins with all the state that it needs: others may draw in
    // between. Returns the number of triangles.
    [[nodiscard]] InParts<std::uint64_t> draw(const Subject& subject, const ViewSetup& view,
                                              const SampleTarget& to) const;

private:
    // Triangles of one branch, and those where branches meet.
    struct Programs {
        Program triangles, borders;
    };
    static void draw_by_sample(const Program& borders, const ViewSetup& view, const SampleTarget& to,
                               const std::function<void()>& draw);

    Programs plain_, valued_; // the others of surfaces that have values
};

class CenterlinePass {
public:
    [[nodiscard]] Result<void> make();
    // What moves fast enough that nobody sees the difference: a rectangle a segment takes a software rasteriser a tenth
    // of the time that its triangles do. Returns the number of triangles.
    [[nodiscard]] std::uint64_t draw_cones(const Subject& subject) const;
    // Of branches of glass: seen through it, and hidden by what is opaque. In parts, as SurfacePass. Returns the number
    // of segments.
    [[nodiscard]] InParts<std::uint64_t> draw_lines(const Subject& subject, const ViewSetup& view,
                                                    const SampleTarget& to) const;

private:
    Program cones_, lines_;
    VertexArray no_vertices_;
};

class ContextPass {
public:
    [[nodiscard]] Result<void> make();
    // In parts, as SurfacePass; and so what is clear.
    [[nodiscard]] InParts<std::uint64_t> draw_opaque(const Subject& subject, const ViewSetup& view,
                                                     const SampleTarget& to) const;

    enum class Clear { kAll, kLesions };
    // Where it goes: bound at the beginning of each part.
    using Begin = std::function<void()>;
    // Gives a program that is in use what it needs beside the mesh.
    using Prepare = std::function<void(const Program&)>;
    [[nodiscard]] InParts<std::uint64_t> draw_clear(const Subject& subject, const ViewSetup& view, Clear what,
                                                    Begin begin, Prepare prepare) const;

private:
    struct ShapeDraw { // of a shape
        const Shape* shape = nullptr;
        GLuint number = 0;
        glm::dmat4 to_clip{1.0}; // from mm about the middle of the shape's bounds
    };
    void add_context(const Subject& subject, const ViewSetup& view, std::vector<ShapeDraw>& to) const;
    void add_lesions(const Subject& subject, const ViewSetup& view, std::vector<ShapeDraw>& to) const;

    Program opaque_, clear_, lines_;
};

// Begins with `program`, one of geometry.vert.
void use_for_vessels(const Program& program, const Subject& subject, const ViewSetup& view);
// After programs with a geometry shader: Mesa holds on to the program that comes right after one, and would keep it for
// good.
void end_borders();

} // namespace ramus::render
