// The organ that a session plans in: its voxels, which branches of each vessel system supply or drain them, and what
// remains after the cuts. Everything here is made on any thread and then immutable.
#pragma once

#include "app/assets/shapes.h"
#include "app/session/session.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/measure/cuts.h"
#include "core/organ/organ.h"
#include "core/organ/remnant.h"
#include "core/organ/resect/dividing_surface.h"
#include "core/organ/supply.h"
#include "core/organ/territories.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct OrganMask {
    organ::Organ organ;
    tree::Claims claims;            // origin of unit and orientation
    std::string suspicion;          // why its unit is implausible; empty: it is not
    std::vector<std::size_t> parts; // voxels of its unconnected parts, the largest first
};

// Reads the mask, or returns `before` if the file is unmodified (null: not read before). If `job` is cancelled, the
// error's `what` is "cancelled", and the result must not be kept.
[[nodiscard]] Loaded<OrganMask> read_organ(const OrganSource& source, const Loaded<OrganMask>* before, Job& job);

// The role of each system of the tree (one for a tree without systems): the session's, or by its name.
[[nodiscard]] std::vector<organ::Role> roles_of(const tree::VesselTree& tree, const Marks& marks);

// The supply of all voxels by each system.
struct OrganSupply {
    struct Of {
        std::shared_ptr<const tree::VesselTree> tree;
        std::shared_ptr<const OrganMask> mask;
        organ::Rule rule = organ::Rule::kTips;
        double large_vessels_mm = 0.0;
        bool operator==(const Of&) const = default;
    };
    Of of;
    std::vector<organ::Supply> systems; // by system; one that does not reach the organ has no voxels
    std::vector<std::uint8_t> large;    // by voxel, not 0: inside a large vessel
    [[nodiscard]] bool reaches(std::size_t system) const { return !systems[system].branch.empty(); }
    // By system; they refer to this supply.
    [[nodiscard]] std::vector<organ::SystemSupply> with_roles(const std::vector<organ::Role>& roles) const;
};
// Fails if no system reaches the organ, and when cancelled (what == "cancelled").
[[nodiscard]] Result<OrganSupply> supply_of(const OrganSupply::Of& of, const JobRange& job);

// A mesh that a resection follows, and the organ that it divides.
struct ResectionMesh {
    std::shared_ptr<const OrganMask> mask;
    Result<std::shared_ptr<const organ::DividingSurface>> surface;
};

struct Assets;           // app/assets/assets.h
struct Operation;        // app/assets/operation.h
struct OrganTerritories; // app/assets/territories.h

// Everything about the organ of a session; missing values are null.
struct OrganAssets {
    OrganSource source; // of `mask`; no file: nothing was read
    Loaded<OrganMask> mask{};
    std::shared_ptr<const OrganSupply> supply{};   // may belong to an earlier tree, mask or rule
    std::map<std::string, ResectionMesh> meshes{}; // of resections, by file
    // By plan of the session: what was made last for it; may belong to earlier marks.
    std::vector<std::shared_ptr<const Operation>> operations{};
    std::size_t plan = 0;                                  // the current one
    std::shared_ptr<const OrganTerritories> territories{}; // may belong to an earlier choice
    std::shared_ptr<const OrganTerritories> compared{};    // of kRemnant: of the compared plan
};
// What the session asks for; none: it has no organ, or something that comes first is missing.
[[nodiscard]] std::optional<OrganSource> wanted_organ(const Marks& marks);
[[nodiscard]] std::optional<OrganSupply::Of> wanted_supply(const OrganAssets& assets, const Marks& marks,
                                                           const std::shared_ptr<const tree::VesselTree>& tree);
// Makes what is missing in the calling thread. Fails with the first error.
[[nodiscard]] Result<void> complete_organ(Assets& assets, const Marks& marks, Job& job);

} // namespace ramus::app
