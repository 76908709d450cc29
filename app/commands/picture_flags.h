// Options of all commands that make pictures.
#pragma once

#include "render/scene/camera.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <glm/vec2.hpp>

namespace ramus::app {

// --size WxH; its help names what `size` is before. Sizes that cannot be drawn are wrong usage.
void add_size_flag(CLI::App& command, glm::ivec2& size);

// --graphics-memory SIZE, of surfaces; in bytes, 0 as the renderer has it.
CLI::Option* add_graphics_memory_flag(CLI::App& command, std::size_t& bytes);

// --view NAME; its help names anterior as what `view` is before.
CLI::Option* add_view_flag(CLI::App& command, render::View& view);

} // namespace ramus::app
