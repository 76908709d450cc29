// ContextPass: what is beside the tree. Opaque context is drawn among the vessels; as fragments among the glass what is
// clear, which are context meshes, their lines, and lesions. Backs of closed meshes are not drawn; open ones are seen
// from both sides. All return the number of triangles.
#pragma once

#include "render/renderer/scene_on_card.h"
#include "render/renderer/targets.h"

#include <functional>

namespace ramus::render {

class ContextPass {
public:
    [[nodiscard]] Result<void> make();
    // Into what is bound.
    [[nodiscard]] std::uint64_t draw_opaque(const Subject& subject, const ViewSetup& view) const;

    enum class Clear { kAll, kLesions };
    // Gives a program that is in use what it needs beside the mesh.
    using Prepare = std::function<void(const Program&)>;
    [[nodiscard]] std::uint64_t draw_clear(const Subject& subject, const ViewSetup& view, Clear what,
                                           const Prepare& prepare) const;

private:
    [[nodiscard]] std::uint64_t draw_context(const Subject& subject, const ViewSetup& view,
                                             const Prepare& prepare) const;
    [[nodiscard]] std::uint64_t draw_lesions(const Subject& subject, const ViewSetup& view,
                                             const Prepare& prepare) const;

    Program opaque_, clear_, lines_;
};

} // namespace ramus::render
