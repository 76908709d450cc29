// The shortest distances from lesions to vessels, as pictures show them.
#pragma once

#include "app/assets/plan.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

namespace ramus::app {

// Which of Plan::vessels a person points at: those of a lesion, of one system or of all (-1).
struct PointedLesion {
    int lesion = -1, system = -1; // lesion -1: none
    bool operator==(const PointedLesion&) const = default;
};

// A line with its length for each shortest distance: all where the session shows them, else those that are pointed at.
// Hidden branches have none unless they are pointed at. `plan` is of `marks`.
void draw_shortest_distances(render::Frame& frame, const Plan& plan, const Marks& marks, const PointedLesion& pointed,
                             const tree::Claims& claims);

} // namespace ramus::app
