// The contacts of a tree (core/tree/contacts/contacts.h) after pruning and smoothing, as its surface sees it, with
// descriptions. Finding them takes seconds for large trees: use a worker.
#pragma once

#include "app/session/numbers.h"
#include "core/mesh/surface_options.h"
#include "core/tree/contacts/contacts.h"

#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

struct TreeContacts {
    int smooth_passes = 0;
    double prune_ratio = 0.0, width = 0.0;
    field::KernelKind kernel = field::KernelKind::kGaussian;
    std::shared_ptr<const std::vector<tree::Contact>> list; // closest first; null: not searched yet
    [[nodiscard]] bool fits(const mesh::SurfaceOptions& options) const {
        return list && smooth_passes == options.smooth_passes && prune_ratio == options.prune_ratio &&
               width == options.width && kernel == options.kernel;
    }
};

[[nodiscard]] TreeContacts contacts_of(const tree::VesselTree& tree, const mesh::SurfaceOptions& options);

// The branches of both sides at the closest place; one branch if it touches itself.
[[nodiscard]] std::vector<int> branches_of(const tree::Contact& contact);

// "gap 0.12 mm", "overlap 0.4 mm", "axes cross, overlap 2 mm": of the tubes, not of the surface.
[[nodiscard]] std::string gap_text(const tree::Contact& contact, const Lengths& lengths);

} // namespace ramus::app
