// --size WxH of commands that make pictures.
#pragma once

#include <CLI/CLI.hpp>
#include <glm/vec2.hpp>

namespace ramus::app {

// Adds the option; its help names what `size` is before. Sizes that cannot be drawn are wrong usage.
void add_size_flag(CLI::App& command, glm::ivec2& size);

} // namespace ramus::app
