// compose(): a session, its assets and its mesh as the Frame that the renderer draws: a function of its arguments
// alone. The window and `ramus render` call the same one, which is why their pictures are the same.
#pragma once

#include "app/picture/ground.h"
#include "app/picture/lesion_lines.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

#include <memory>
#include <optional>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// What the picture depends on beside the session.
struct Viewing {
    glm::ivec2 size{1280, 960}; // pixels
    float pixel_ratio = 1.0F;
    int hovered = render::kNoBranch; // what depends on it glows with it
    Ground ground = Ground::kDark;
    std::optional<mesh::Method> method{}; // of the surface that is shown, where it is not the session's
    render::Quality quality = render::Quality::kFull;
    std::optional<GlassLook> glass{};                  // instead of the session's, while it is being tried
    std::optional<std::vector<ContextItem>> context{}; // likewise
    std::optional<mesh::SurfaceOptions> options{};     // likewise
    std::optional<render::AxisNames> axes{};           // likewise: instead of those that are known
    bool notes = false;           // the places that reading the tree repaired or suspects are marked
    int note = -1;                // this one more than the others; -1: none
    int measurement = kNoObject;  // the id of the measurement that is left out, because a tool draws it
    PointedLesion lesion{};       // the shortest distances of this one are drawn, more than the others if these are
    bool context_awaited = false; // what is visible of the session's context is not all there yet
    int contact = -1;             // of the contacts this one is marked, more than the others if these are; -1: none
};

// Sides and a unit are shown where somebody has said them of the tree.
void show_claims(render::Frame& frame, const tree::Claims& claims);

// `assets` are those of the session; what is not there yet is not shown, and without a tree
// there are no colours. `mesh` may be null: an empty picture.
[[nodiscard]] render::Frame compose(const Session& session, const Assets& assets,
                                    std::shared_ptr<const render::PagedMesh> mesh, const Viewing& viewing);

} // namespace ramus::app
