// ramus validate: what it is asked for, and the look at one data set.
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
    std::vector<std::string> trees, masks, meshes; // of masks and meshes none, or one for each tree
    std::filesystem::path report;                  // a folder; empty: none
    std::string mesh_axes;                         // of surfaces that do not state them; empty: not given
    bool kernels = false;                          // compare these instead
    bool json = false;

    [[nodiscard]] std::size_t count() const { return trees.size(); }
    [[nodiscard]] std::string mask(std::size_t n) const { return masks.empty() ? std::string() : masks[n]; }
    [[nodiscard]] std::string mesh(std::size_t n) const { return meshes.empty() ? std::string() : meshes[n]; }
    [[nodiscard]] std::vector<std::string> files(std::size_t n) const; // of data set n, those that are given
};

// Throws CLI::ValidationError where an option is given neither never nor once for each tree.
void check_one_for_each(const std::string& option, std::size_t count, std::size_t trees);

// All trees. Of several data sets also the masks and surfaces are read, and let go again: what is wrong with a file is
// said before anything is computed. Errors name the file.
[[nodiscard]] Result<std::vector<tree::VesselTree>> read_all(const ValidateFlags& flags);

// Data set `n`, whose tree has been read. With a painter, all that a report needs besides: pictures, radii in cones and
// mask, the farthest places, checksums. One data set at a time, each on all cores: memory is that of the largest.
[[nodiscard]] Result<ValidatedDataSet> validated(const ValidateFlags& flags, std::size_t n,
                                                 const tree::VesselTree& tree, ValidationPainter* painter);

} // namespace ramus::app
