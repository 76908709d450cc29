// `ramus mesh --method iso`: the surface of a segmentation mask, or of a scan at an isovalue.
#pragma once

#include "app/commands/surface_flags.h"
#include "app/commands/write_surface.h"
#include "core/volume/bit_mask.h"

#include <CLI/CLI.hpp>
#include <string>

namespace ramus::app {

struct MaskFlags {
    bool iso = false;
    volume::Selection selection;
};

// --label and --isovalue.
void add_mask_flags(CLI::App& command, MaskFlags& flags);

// Throws CLI::ValidationError for options that do not go with the method chosen.
void check_mask_flags(const CLI::App& command, const MaskFlags& flags);

// Reads, makes and writes. `load_s` is set to the seconds that reading took.
[[nodiscard]] Result<WrittenSurface> mesh_of_mask(const std::string& file, const MaskFlags& mask,
                                                  const SurfaceFlags& flags, const std::string& output, double& load_s);

} // namespace ramus::app
