// The window: opens a tree or a session (the demo tree when none is given) and stays until the person closes it.
// Returns the exit status. Without a display it says so and points at `ramus render`.
#pragma once

#include "core/io/trees/tree_file.h"
#include "core/mesh/surface_options.h"

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace ramus::app {

struct WindowOptions {
    std::vector<std::string> files;
    std::string session;    // a session file; instead of a tree
    std::string commands;   // a commands file, run when the surface is ready
    bool overwrite = false; // its commands may replace files that are there
    std::string status; // a file that says in JSON, at every change, what the window shows: for scripts that drive it
    mesh::SurfaceOptions surface;
    io::ReadOptions read;
    float scale = 0.0F;             // pixels per point; 0: the settings', else the display's
    glm::ivec2 size{0};             // points; 0: the settings', else as the monitor suggests
    std::size_t graphics_bytes = 0; // for surfaces; 0: as the renderer has it
};

int run_window(const WindowOptions& options);

} // namespace ramus::app
