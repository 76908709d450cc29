// The resections that the command line of `ramus resect` asks for: planes, sheets, surfaces, cuts and lesions.
#pragma once

#include "app/commands/organ_case.h"
#include "core/base/error.h"
#include "core/measure/cuts.h"
#include "core/organ/resect/resection.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct ResectionFlags {
    std::vector<organ::HalfSpace> planes;
    std::vector<std::string> surfaces, sheets; // files
    std::string mesh_axes;                     // of the surfaces; empty: not given
    std::vector<measure::Cut> cuts;
    std::string wedge; // mask of lesions to remove; empty: none
    std::optional<double> margin_mm;
    bool other_side = false;
};

// Adds --plane, --surface, --sheet, --cut, --lesion, --margin, --other-side and --mesh-orientation.
void add_resection_options(CLI::App& command, ResectionFlags& flags);
// Throws CLI::ValidationError if no resection is given, or if --margin does not go with the others.
void check_resection_flags(const CLI::App& command, const ResectionFlags& flags);

struct NamedResection {
    std::string kind; // "plane", "sheet", "surface", "cuts", "lesion"
    organ::Resection resection;
};
// Reads the files. `systems`: supplies_by_system() of the case; used for cuts. Fails if a file cannot be read, if an
// open surface does not divide the organ, and if the cuts lose no voxel.
[[nodiscard]] Result<std::vector<NamedResection>> resections_of(const OrganCase& read, const OrganFlags& organ_flags,
                                                                const ResectionFlags& flags,
                                                                const SystemSupplies& systems);

// The lesions of a mask: each label (or those of `labels`), and of each the parts that do not touch by faces.
[[nodiscard]] Result<std::vector<organ::VoxelLesion>> load_lesions(const std::string& file, const OrganFlags& flags);

} // namespace ramus::app
