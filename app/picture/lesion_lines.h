// Draws the shortest distances from lesions to vessels and to resections.
#pragma once

#include "app/assets/plan.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

namespace ramus::app {

// The entries of Plan::vessels under the pointer: of a lesion and one system, or all systems (-1).
struct PointedLesion {
    int lesion = -1, system = -1; // lesion -1: none
    bool operator==(const PointedLesion&) const = default;
};

// Adds a line labelled with its length per shortest distance: all if the session shows them, otherwise those pointed
// at. Hidden branches are omitted unless pointed at. `plan`: of `marks`.
void draw_shortest_distances(render::Frame& frame, const Plan& plan, const Marks& marks, const PointedLesion& pointed,
                             const tree::Claims& claims);

// Adds a line labelled with its length per margin of a visible lesion that the current plan's resections leave, as they
// were measured last. Nothing if all resections are hidden.
void draw_margins(render::Frame& frame, const Assets& assets, const Marks& marks);

} // namespace ramus::app
