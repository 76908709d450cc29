// Passes that draw into samples. SurfacePass: triangles of opaque vessels, with id and normal per sample.
// CenterlinePass: the same vessels as round cones where that is faster, and the centerlines inside glass.
//
// ContextPass: meshes next to the tree. Opaque context is drawn among the vessels; transparent context, its lines and
// lesions become fragments among the glass. Back faces of closed meshes are not drawn; open meshes show both sides. All
// return the number of triangles.
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
    // Draws in parts of a few milliseconds. Each part sets all state that it needs, so other code may draw in between.
    // Returns the number of triangles.
    [[nodiscard]] InParts<std::uint64_t> draw(const Subject& subject, const ViewSetup& view,
                                              const SampleTarget& to) const;
    // Caps the vessels where the frame cuts them away and the eye sees it, see shaders/caps.glsl. In parts, too; after
    // everything else that is opaque.
    [[nodiscard]] InParts<std::uint64_t> draw_caps(const Subject& subject, const ViewSetup& view,
                                                   const SampleTarget& to) const;

private:
    // `triangles`: for triangles of one branch; `borders`: for those where branches meet.
    struct Programs {
        Program triangles, borders;
    };
    static void draw_by_sample(const Program& borders, const ViewSetup& view, const SampleTarget& to,
                               const std::function<void()>& draw);

    Programs plain_, valued_; // valued_: for surfaces with values
};

class CenterlinePass {
public:
    [[nodiscard]] Result<void> make();
    // For moving views, where the difference is invisible: one rectangle per segment takes a software rasteriser a
    // tenth of the time of the segment's triangles. Returns the number of triangles.
    [[nodiscard]] std::uint64_t draw_cones(const Subject& subject) const;
    // Draws the centerlines of glass branches: visible through glass, hidden by opaque surfaces. In parts, as
    // SurfacePass. Returns the number of segments.
    [[nodiscard]] InParts<std::uint64_t> draw_lines(const Subject& subject, const ViewSetup& view,
                                                    const SampleTarget& to) const;

private:
    Program cones_, lines_;
    VertexArray no_vertices_;
};

class ContextPass {
public:
    [[nodiscard]] Result<void> make();
    // In parts, as SurfacePass; draw_clear() too.
    [[nodiscard]] InParts<std::uint64_t> draw_opaque(const Subject& subject, const ViewSetup& view,
                                                     const SampleTarget& to) const;

    // As of SurfacePass, for closed opaque meshes; before it, so that vessels within them are seen.
    [[nodiscard]] InParts<std::uint64_t> draw_caps(const Subject& subject, const ViewSetup& view,
                                                   const SampleTarget& to) const;

    enum class Clear { kAll, kLesions };
    // Binds the target at the beginning of each part.
    using Begin = std::function<void()>;
    // Sets the inputs of a program in use, other than the mesh.
    using Prepare = std::function<void(const Program&)>;
    [[nodiscard]] InParts<std::uint64_t> draw_clear(const Subject& subject, const ViewSetup& view, Clear what,
                                                    Begin begin, Prepare prepare) const;

private:
    struct ShapeDraw {
        const Shape* shape = nullptr;
        GLuint number = 0;
        glm::dmat4 to_clip{1.0}; // from the shape's positions, which are at `origin` + `scale` times them, mm
        glm::dvec3 origin{0.0};
        double scale = 1.0;
    };
    void add_context(const Subject& subject, const ViewSetup& view, std::vector<ShapeDraw>& to) const;
    void add_lesions(const Subject& subject, const ViewSetup& view, std::vector<ShapeDraw>& to) const;

    Program opaque_, clear_, lines_;
};

// Uses `program`, whose vertex shader must be geometry.vert.
void use_for_vessels(const Program& program, const Subject& subject, const ViewSetup& view);
// Call after programs with a geometry shader: Mesa keeps a reference to the next program forever.
void end_borders();

} // namespace ramus::render
