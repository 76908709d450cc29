// What a plan of an operation removes of the organ, what remains, which vessels it cuts, and how far lesions are from
// the cut. Made on any thread and then immutable.
#pragma once

#include "app/assets/organ.h"
#include "core/mesh/triangle_mesh.h"
#include "core/organ/resect/cut_vessels.h"
#include "core/organ/resect/lesion_margin.h"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// A lesion of the session that is read.
struct PlannedLesion {
    int id = kNoObject;
    std::string name;                       // for people
    std::array<double, 4> sphere{};         // unused for meshes
    std::shared_ptr<const LesionMesh> mesh; // null: a sphere
    bool operator==(const PlannedLesion&) const = default;
};
[[nodiscard]] std::vector<PlannedLesion> planned_lesions(const Assets& assets, const Marks& marks);

struct Operation {
    struct Of {
        std::shared_ptr<const OrganSupply> supply;
        std::vector<organ::Role> roles; // by system
        std::vector<measure::Cut> cuts;
        std::vector<Resection> resections; // without looks and ids
        std::vector<PlannedLesion> lesions;
        std::vector<double> bands_mm;                                                // margins around lesions
        std::map<std::string, std::shared_ptr<const organ::DividingSurface>> meshes; // of `resections`, by file
        bool operator==(const Of&) const = default;
    };
    Of of;
    std::vector<int> ids; // of the resections in the marks that it was made for; 0: of a plan that waits
    // Voxels: numbers of whole ones without resections.
    double functional = 0.0;    // without lesions and large vessels, before the operation
    double removed = 0.0;       // of the whole organ, by resections
    organ::PartRemnant remnant; // of the functional organ; `lost` by system, 0 for those that do not reach the organ
    double area_mm2 = 0.0;      // of the surface that resections leave
    // Cut by resections and by the plan's cuts, which have no resection: its index is their number. The thickest first.
    std::vector<organ::CutVessel> vessels;
    std::vector<organ::Margin> margins; // by lesion, to the resections
    // By resection: its surface within the organ, divided by the distance from the nearest lesion into the margins
    // (bands_mm) and what is beyond; one part without lesions, none where it does not meet the organ.
    using Parts = std::vector<std::shared_ptr<const mesh::TriangleMesh>>;
    std::vector<Parts> surfaces;
    std::vector<float> kept; // by voxel: the share that resections leave; empty: all

    [[nodiscard]] double voxel_ml() const { return of.supply->of.mask->organ.voxel_ml(); }
    // Whether some system that reaches the organ has this role.
    [[nodiscard]] bool has(organ::Role role) const;
};

struct OperationWork {
    std::size_t plan = 0;
    Operation::Of of;
    std::vector<int> ids; // of its resections
    bool operator==(const OperationWork&) const = default;
};
// Those of the session's plans that `assets` lack and that can be made, the current plan's first.
[[nodiscard]] std::vector<OperationWork> wanted_operations(const Assets& assets, const Marks& marks);
// Fails when cancelled (what == "cancelled").
[[nodiscard]] Result<Operation> make_operation(const OperationWork& work, const JobRange& job);
void put_operation(Assets& assets, std::size_t plan, std::shared_ptr<const Operation> made);
// The parts of the surface of a resection of the current plan, as they were made last; null: none were made.
[[nodiscard]] const Operation::Parts* surface_of(const Assets& assets, const Resection& resection);
// As many as there are plans; equal plans share theirs.
void tidy_operations(Assets& assets, const Marks& marks);
// What was made last for a plan, perhaps from earlier marks; null: nothing.
enum class OperationOf : std::uint8_t { kNow, kLast };
[[nodiscard]] std::shared_ptr<const Operation> operation_of(const Assets& assets, const Marks& marks, std::size_t plan,
                                                            OperationOf which = OperationOf::kNow);

struct ResectionMeshOf {
    std::string file, axes;
    std::shared_ptr<const OrganMask> mask;
    bool operator==(const ResectionMeshOf&) const = default;
};
// Meshes of resections that are not read, or that were read for another organ.
[[nodiscard]] std::vector<ResectionMeshOf> wanted_meshes(const OrganAssets& assets, const Marks& marks);
[[nodiscard]] ResectionMesh read_resection_mesh(const ResectionMeshOf& of, const JobRange& job);

// By voxel of the organ, 1: it is functional, 0: inside a lesion or a large vessel.
[[nodiscard]] std::vector<std::uint8_t> functional_voxels(const OrganSupply& supply,
                                                          const std::vector<PlannedLesion>& lesions);
// By voxel of the organ, not 0: its centre is inside a lesion, or at most `margin_mm` from one.
[[nodiscard]] std::vector<std::uint8_t> voxels_in(const organ::Organ& organ, const std::vector<PlannedLesion>& lesions,
                                                  double margin_mm = 0.0);

} // namespace ramus::app
