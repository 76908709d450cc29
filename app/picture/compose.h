// compose(): a session and its mesh as the Frame that the renderer draws. The window and `ramus render` call the same
// function, which is why their pictures are the same.
#pragma once

#include "app/session/document.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

#include <memory>
#include <optional>
#include <span>

namespace ramus::app {

// What the picture depends on beside the session.
struct Viewing {
    glm::ivec2 size{1280, 960}; // pixels
    float pixel_ratio = 1.0F;
    int hovered = render::kNoBranch;
    std::span<const int> hovered_dependents{}; // they glow with it
    bool transparent = false;
    std::optional<mesh::Method> method{}; // of the surface that is shown, where it is not the session's
    render::Quality quality = render::Quality::kFull;
    std::shared_ptr<const Plan> plan{}; // of the session; null: lesions and cuts are not shown
    std::shared_ptr<const std::vector<Result<Measured>>> measurements{}; // of the session; null: none are shown
    std::optional<GlassLook> glass{};                  // instead of the session's, while it is being tried
    std::optional<std::vector<ContextItem>> context{}; // likewise
    std::optional<mesh::SurfaceOptions> options{};     // likewise
};

// `tree` may be null: no colours; `mesh` may be null: an empty picture.
[[nodiscard]] render::Frame compose(const Session& session, const std::shared_ptr<const tree::VesselTree>& tree,
                                    std::shared_ptr<const render::PagedMesh> mesh, const Viewing& viewing);

// The document's session with its plan and measurements: what windows and files show.
[[nodiscard]] render::Frame compose(const Document& document, std::shared_ptr<const render::PagedMesh> mesh,
                                    Viewing viewing);

} // namespace ramus::app
