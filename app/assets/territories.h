// The territories of the organ that a session shows: its parts by the branches that supply or drain them, with their
// surfaces. Made on any thread and then immutable.
#pragma once

#include "app/assets/operation.h"
#include "core/mesh/triangle_mesh.h"
#include "core/organ/certainty.h"

#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct OrganTerritories {
    // What they are of. Only what the kind needs is set.
    struct Of {
        std::shared_ptr<const OrganSupply> supply;
        TerritoriesOf kind = TerritoriesOf::kNothing;
        int generation = 0;
        int system = 0;                                 // whose branches divide the organ
        std::vector<std::pair<int, std::string>> named; // of kNames and kSelection: heads of subtrees
        std::vector<measure::Cut> cuts;                 // of kCuts
        std::shared_ptr<const Operation> operation;     // of kRemnant
        double apart_mm = 0.0;                          // of kRemnant: how far the removed part is pulled away
        bool operator==(const Of&) const = default;
    };
    struct Part {
        std::string name;
        int system = -1; // of kSystems
        bool rest = false;
        std::size_t voxels = 0;
        std::shared_ptr<const mesh::TriangleMesh> mesh;    // closed, with normals
        std::shared_ptr<const mesh::TriangleMesh> preview; // fewer triangles; null: the mesh is small
    };
    Of of;
    std::vector<Part> parts;                    // those with voxels
    std::vector<std::uint16_t> part_of{};       // by voxel of the organ: the index of its part + 1; 0: none
    std::optional<organ::Certainty> expected{}; // how sure they are, on average in grown organs; none: not measured

    [[nodiscard]] double volume_mm3(const Part& part) const;
    [[nodiscard]] double percent(const Part& part) const; // of the organ
};

struct TerritoryWork {
    OrganTerritories::Of of;
    bool compared = false; // of the compared plan
    bool operator==(const TerritoryWork&) const = default;
};
// Those that the session shows and `assets` lack, and that can be made.
[[nodiscard]] std::vector<TerritoryWork> wanted_territories(const Assets& assets, const Marks& marks);
void put_territories(OrganAssets& assets, const TerritoryWork& work, std::shared_ptr<const OrganTerritories> made);
// Removes those that are no longer shown.
void tidy_territories(OrganAssets& assets, const Marks& marks);
// Fails if no branch of a group reaches the organ, and when cancelled (what == "cancelled").
[[nodiscard]] Result<OrganTerritories> make_territories(const OrganTerritories::Of& of, const JobRange& job);

// The parts of kRemnant, in their order.
enum class RemnantPart : std::uint8_t { kKept, kNotDrained, kNotSupplied, kLost, kRemoved };
inline constexpr std::array<std::string_view, 5> kRemnantParts{"kept", "not drained", "not supplied", "neither",
                                                               "removed"};

} // namespace ramus::app
