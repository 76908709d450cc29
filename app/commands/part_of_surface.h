// Surfaces that are made in parts: `ramus mesh --part`, and by the processes of a team (app/mpi).
#pragma once

#include "app/commands/write_surface.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

namespace ramus::app {

// Adds --part I/N.
void add_part_flag(CLI::App& command, std::optional<mesh::PartOf>& part);

// Throws CLI::ValidationError for what parts do not have: standard output for a team, masks, printing.
void check_divided(const CLI::App& command, const std::filesystem::path& output, bool is_mask);

// What `ramus mesh --part` prints: a line, or JSON. A part has a border, and nothing of it is repaired.
[[nodiscard]] std::string part_report(const WrittenSurface& written, const mesh::PartOf& part,
                                      const std::filesystem::path& output, double load_s, bool json);

} // namespace ramus::app
