// Runs the window: opens a tree or a session (by default the demo tree) until the user closes it. Returns the exit
// status. Without a display prints an error that points to `ramus render`.
#pragma once

#include "core/io/trees/tree_file.h"
#include "core/mesh/surface_options.h"

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace ramus::app {

struct WindowOptions {
    std::vector<std::string> files;
    std::string session;    // a session file, instead of a tree
    std::string commands;   // a commands file, run once the surface is ready
    bool overwrite = false; // commands may replace existing files
    std::string status;     // JSON file with what the window shows, updated at every change; for scripts
    mesh::SurfaceOptions surface;
    io::ReadOptions read;
    float scale = 0.0F;             // pixels per point; 0: from settings, else from the display
    glm::ivec2 size{0};             // points; 0: from settings, else suited to the monitor
    std::size_t graphics_bytes = 0; // limit for surfaces; 0: the renderer's default
};

int run_window(const WindowOptions& options);

} // namespace ramus::app
