// Pictures of a document as another session would show it: of a plan that is not the current one, of other territories.
#pragma once

#include "app/picture/compose.h"
#include "app/session/document.h"
#include "core/base/error.h"
#include "core/base/job.h"

#include <cstddef>

namespace ramus::app {

// As compose(), with the cuts and resections of `plan`, and with its territories where they are compared
// (Plans::compared).
[[nodiscard]] render::Frame compose_plan(const Session& session, const Assets& assets,
                                         std::shared_ptr<const render::PagedMesh> mesh, Viewing viewing,
                                         std::size_t plan);

// As compose(), for a session of the document's tree with other marks or another camera. Reads and computes what it
// lacks in the calling thread, except surfaces: `mesh` shows the branches that are hidden there. Fails as complete().
[[nodiscard]] Result<render::Frame> compose_as(const Session& session, const Document& document, Assets assets,
                                               std::shared_ptr<const render::PagedMesh> mesh, const Viewing& viewing,
                                               Job& job);

} // namespace ramus::app
