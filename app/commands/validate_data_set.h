// The options of `ramus validate`, and the validation of one data set: a tree with its surface, and perhaps its mask.
#pragma once

#include "app/commands/surface_flags.h"
#include "app/commands/surface_input.h"
#include "app/commands/validate_pictures.h"
#include "app/reports/validation/data_set.h"
#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ramus::app {

struct ValidateFlags {
    SurfaceFlags surface;
    MaskInput labels;
    std::vector<std::string> trees, masks, meshes; // files; masks and meshes: none, or one for each tree
    std::filesystem::path report;                  // folder of --report; empty: none
    std::string mesh_axes;                         // of meshes that do not state their axes; empty: not given
    bool kernels = false;                          // compare kernels instead of validating
    bool json = false;

    [[nodiscard]] std::size_t count() const { return trees.size(); }
    [[nodiscard]] std::string mask(std::size_t n) const { return masks.empty() ? std::string() : masks[n]; }
    [[nodiscard]] std::string mesh(std::size_t n) const { return meshes.empty() ? std::string() : meshes[n]; }
    [[nodiscard]] std::vector<std::string> files(std::size_t n) const; // all files of data set n
};

// Throws CLI::ValidationError unless an option is given as often as there are trees, or not at all.
void check_one_for_each(const std::string& option, std::size_t count, std::size_t trees);

// Reads all trees. If there are several data sets, also reads all masks and surfaces, and discards them: a file that
// cannot be read is reported before any computation. Errors name the file.
[[nodiscard]] Result<std::vector<tree::VesselTree>> read_all(const ValidateFlags& flags);

// Validates data set `n`; `tree` is its tree. If `painter` is not null, also computes what a report needs: pictures,
// radii of the cones and the mask, the places that are farthest apart, and checksums. Uses all cores, so callers
// validate one data set after the other. Shows progress bars; fails if a file cannot be read or the job is cancelled.
[[nodiscard]] Result<ValidatedDataSet> validated(const ValidateFlags& flags, std::size_t n,
                                                 const tree::VesselTree& tree, ValidationPainter* painter);

} // namespace ramus::app
