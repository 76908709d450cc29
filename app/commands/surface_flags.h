// The options of reading trees and computing surfaces, which all commands and the window share. Values outside an
// option's domain are wrong usage. The objects that parsing writes to must live as long as the command.
#pragma once

#include "core/io/trees/tree_file.h"
#include "core/mesh/surface_options.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct SurfaceFlags {
    mesh::SurfaceOptions surface;
    io::ReadOptions read;
    std::vector<std::string> systems;  // --system: only these are shown; empty: all
    bool verbose = false;              // --verbose: report each step on standard error
    const CLI::App* command = nullptr; // that has these options; null: no add_surface_flags()

    // The options of `session`, with those replaced that the command line gives.
    [[nodiscard]] mesh::SurfaceOptions over(mesh::SurfaceOptions session) const;
    [[nodiscard]] io::ReadOptions over(const io::ReadOptions& session) const;
};

// Adds all options of surfaces, --memory, and those of add_source_flags().
void add_surface_flags(CLI::App& command, SurfaceFlags& flags);

// Adds only the options that prepare a tree for its surface and blend its vessels: --smooth, and --prune, --centerline,
// --width and --kernel, which need the option `needing` of the same command.
void add_preparing_flags(CLI::App& command, SurfaceFlags& flags, CLI::Option* needing);

// Adds only --units, for a command that reads a mask.
void add_units_flag(CLI::App& command, io::ReadOptions& read);

// Adds --mask-units. `masks`: the masks that it applies to, for the help, such as "--mask". Empty units: as the file
// says.
CLI::Option* add_mask_units_flag(CLI::App& command, std::string& units, const std::string& masks);

// Adds --mesh-orientation LPS|RAS, the axes of meshes that do not state them. `meshes`: the meshes that it applies to,
// for the help, such as "--surface". Empty axes: not given.
CLI::Option* add_mesh_orientation_flag(CLI::App& command, std::string& axes, const std::string& meshes);

// Adds --axes LPS|RAS, the axes of an output; none: not given.
void add_axes_flag(CLI::App& command, std::optional<io::Orientation>& axes, const std::string& help);

// Adds --method with all methods that compute surfaces of trees; `with_masks`: also those of masks. Passes the value to
// `take`.
void add_method_flag(CLI::App& command, bool with_masks, const std::function<void(mesh::Method)>& take);

// Adds --system NAME, for commands that open sessions.
void add_system_flag(CLI::App& command, SurfaceFlags& flags);

// Adds the options of skeletonizing a mask: --root, --isovalue, --fill-holes, --islands and --bulge-size.
void add_mask_reading_flags(CLI::App& command, io::MaskReading& mask);

// Adds the options of reading a tree file: --repair, --units, --radius-is, --radius, --orientation, --columns, --data,
// and --verbose.
void add_reading_flags(CLI::App& command, SurfaceFlags& flags);

// Adds the options of reading a tree from a tree file or a mask: add_reading_flags(), add_mask_reading_flags() and
// --labels.
void add_source_flags(CLI::App& command, SurfaceFlags& flags);

} // namespace ramus::app
