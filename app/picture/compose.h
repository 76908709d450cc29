// compose(): converts a session, its assets and its mesh to the Frame that the renderer draws. A pure function: the
// window and `ramus render` call it, so their pictures are equal.
#pragma once

#include "app/picture/ground.h"
#include "app/picture/lesion_lines.h"
#include "app/session/session.h"
#include "render/scene/frame.h"
#include "render/scene/scan_plane.h"

#include <memory>
#include <optional>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// Inputs of the picture that are not part of the session.
struct Viewing {
    glm::ivec2 size{1280, 960}; // pixels
    float pixel_ratio = 1.0F;
    int hovered = render::kNoBranch; // its dependents glow, too
    Ground ground = Ground::kDark;
    std::optional<mesh::Method> method{}; // of the shown surface, if not the session's
    render::Quality quality = render::Quality::kFull;
    std::optional<GlassLook> glass{};              // trial value that replaces the session's
    std::optional<SceneObjects> objects{};         // trial value
    std::optional<mesh::SurfaceOptions> options{}; // trial value
    std::optional<double> territories_opacity{};   // trial value
    std::optional<render::AxisNames> axes{};       // trial value that replaces the known names
    bool notes = false;                            // marks the places that reading the tree repaired or suspects
    int note = -1;                                 // index of the emphasised note; -1: none
    int measurement = kNoObject;             // id of a measurement to omit, because a tool draws it; kNoObject: none
    PointedLesion lesion{};                  // draws its shortest distances, emphasised if others are drawn
    std::vector<render::ScanPlane> planes{}; // slices among the vessels (app/picture/plane_pictures.h)
    bool context_awaited = false;            // some visible context is still being read
    int contact = -1;                        // index of a contact to mark, emphasised if others are marked; -1: none
};

// Shows the patient's sides and a unit if the tree claims them.
void show_claims(render::Frame& frame, const tree::Claims& claims);

// `assets`: of the session; missing assets are not drawn, and without a tree there are no colours. `mesh` may be null:
// an empty picture.
[[nodiscard]] render::Frame compose(const Session& session, const Assets& assets,
                                    std::shared_ptr<const render::PagedMesh> mesh, const Viewing& viewing);

} // namespace ramus::app
