// The options that hold wherever a tree becomes a surface: on every such command and on the window alike. Values
// outside their domain are wrong usage, found while the command line is read.
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
    std::vector<std::string> systems;  // these alone are shown; empty: all
    bool verbose = false;              // say on standard error what is going on
    const CLI::App* command = nullptr; // that has been parsed into this; null: it has no surface options

    // What a session asks for, but for what the command line says.
    [[nodiscard]] mesh::SurfaceOptions over(mesh::SurfaceOptions session) const;
    [[nodiscard]] io::ReadOptions over(const io::ReadOptions& session) const;
};

// Adds the options to `command`; parsing writes to `flags`, which must live as long as the command.
void add_surface_flags(CLI::App& command, SurfaceFlags& flags);

// Only those that say how a tree is prepared for its surface and how it blends, --smooth, --prune, --centerline,
// --width and --kernel, for `needing`, an option of the same command.
void add_preparing_flags(CLI::App& command, SurfaceFlags& flags, CLI::Option* needing);

// --units, of a command that reads nothing but a mask.
void add_units_flag(CLI::App& command, io::ReadOptions& read);

// --mask-units; `masks`: those that it is of, "--mask". Empty units: as the file says.
CLI::Option* add_mask_units_flag(CLI::App& command, std::string& units, const std::string& masks);

// --mesh-orientation LPS|RAS, of `meshes`, "--surface", that do not state their axes. Empty: not given.
CLI::Option* add_mesh_orientation_flag(CLI::App& command, std::string& axes, const std::string& meshes);

// --axes LPS|RAS, of what is written; none: not given.
void add_axes_flag(CLI::App& command, std::optional<io::Orientation>& axes, const std::string& help);

// --method, of those that make surfaces of trees, `with_masks` of all; `take` is called with what is given.
void add_method_flag(CLI::App& command, bool with_masks, const std::function<void(mesh::Method)>& take);

// --system NAME, of commands that open sessions.
void add_system_flag(CLI::App& command, SurfaceFlags& flags);

// Of commands that make a tree of a mask: --fill-holes, --islands, --bulge-size, --root.
void add_mask_reading_flags(CLI::App& command, io::MaskReading& mask);

// Only those about reading a tree's file: --repair, --units and its like, --verbose.
void add_reading_flags(CLI::App& command, SurfaceFlags& flags);

// Those about what becomes a tree, a tree's file or a mask: add_reading_flags(), add_mask_reading_flags(), --labels.
void add_source_flags(CLI::App& command, SurfaceFlags& flags);

} // namespace ramus::app
