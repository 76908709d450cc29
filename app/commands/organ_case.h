// What commands about an organ have in common: the organ of a mask, the trees that supply and drain it, lesions, and
// label maps. Used by `territories` and `resect`.
#pragma once

#include "app/commands/surface_flags.h"
#include "core/base/error.h"
#include "core/measure/cuts.h"
#include "core/organ/organ.h"
#include "core/organ/remnant.h"
#include "core/organ/supply.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/label_choice.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct OrganFlags {
    SurfaceFlags reading;
    std::string tree, organ, lesions, mask_units;
    std::vector<volume::LabelChoice> organ_labels, lesion_labels; // empty: all
    organ::SupplyOptions supply;
    std::vector<std::string> drains;
    double large_vessels_mm = 5.0;
};

// Adds --organ, --organ-label, --lesions, --lesion-label, --mask-units, --by, --drains and --large-vessels.
void add_organ_options(CLI::App& command, OrganFlags& flags);

// Adds an option with labels of a mask, by number or name.
void add_labels_option(CLI::App& command, const char* name, std::vector<volume::LabelChoice>& labels, const char* help);

// Parses "12@0.3": a branch, and a fraction of its length; 0 without it.
[[nodiscard]] std::optional<measure::Cut> cut_in(std::string_view word);
// Parses "12@0.3,40": cuts of different branches, one or more.
[[nodiscard]] std::optional<std::vector<measure::Cut>> cuts_in(std::string_view text);
// Fails if the tree has no such branch. `file`: the tree's.
[[nodiscard]] Result<void> check_branch(const tree::VesselTree& tree, int branch, const std::string& file);

// What the files hold.
struct OrganCase {
    tree::VesselTree tree;
    organ::Organ organ;
    tree::Claims claims;                  // of the organ's mask
    std::vector<organ::Role> roles;       // by system
    std::vector<std::uint8_t> functional; // by voxel of the organ: neither in a lesion nor in a large vessel
    std::size_t functional_voxels = 0;
    std::vector<std::size_t> parts; // of the organ, in voxels: those that do not touch by faces
    [[nodiscard]] std::size_t system_count() const { return roles.size(); }
};
// Reads the tree and the masks. Warns on standard error if the organ has several parts.
[[nodiscard]] Result<OrganCase> load_case(const OrganFlags& flags);

// The voxels of a mask. `claims`: receives the mask's, unless null.
[[nodiscard]] Result<organ::Organ> load_organ(const std::string& file, const std::vector<volume::LabelChoice>& labels,
                                              const SurfaceFlags& reading, tree::Claims* claims = nullptr);
// The flags for reading masks: with the unit of --mask-units.
[[nodiscard]] SurfaceFlags mask_flags(const OrganFlags& flags);

// The branch of each voxel, without the branches whose entry in `excluded` is not 0.
[[nodiscard]] Result<organ::Supply> supply_by(const OrganCase& read, const OrganFlags& flags,
                                              const std::vector<std::uint8_t>& excluded);

// The branch of each voxel by each system on its own, without its stem.
struct SystemSupplies {
    std::vector<organ::Supply> supplies;    // by system
    std::vector<organ::SystemSupply> parts; // refer to `supplies`
};
[[nodiscard]] Result<SystemSupplies> supplies_by_system(const OrganCase& read, const OrganFlags& flags);

[[nodiscard]] std::string name_of_system(const tree::VesselTree& tree, int system); // empty: it has no name

// Writes a label map on the grid of the organ's mask. label_of(number) is the label of a voxel of the organ.
[[nodiscard]] Result<void> write_case_labels(const OrganCase& read, const std::vector<std::string>& names,
                                             const std::function<std::uint16_t(std::size_t)>& label_of,
                                             const std::string& output);

} // namespace ramus::app
