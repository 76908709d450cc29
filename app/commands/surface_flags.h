// The options that hold wherever a tree becomes a surface: on every such command and on the window alike. Values
// outside their domain are wrong usage, found while the command line is read.
#pragma once

#include "core/io/trees/tree_file.h"
#include "core/mesh/surface.h"

#include <CLI/CLI.hpp>
#include <functional>

namespace ramus::app {

struct SurfaceFlags {
    mesh::SurfaceOptions surface;
    io::ReadOptions read;
    bool verbose = false;              // say on standard error what is going on
    const CLI::App* command = nullptr; // that has been parsed into this

    // What a session asks for, but for what the command line says.
    [[nodiscard]] mesh::SurfaceOptions over(mesh::SurfaceOptions session) const;
};

// Adds the options to `command`; parsing writes to `flags`, which must live as long as the command.
void add_surface_flags(CLI::App& command, SurfaceFlags& flags);

// --method, of those that make surfaces of trees, `with_masks` of all; `take` is called with what is given.
void add_method_flag(CLI::App& command, bool with_masks, const std::function<void(mesh::Method)>& take);

// Only those about reading a tree: --repair and --verbose.
void add_reading_flags(CLI::App& command, SurfaceFlags& flags);

} // namespace ramus::app
