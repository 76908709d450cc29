// Options of all commands that make pictures.
#pragma once

#include "app/session/session.h"
#include "render/scene/camera.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

// --size WxH; its help names what `size` is before. Sizes that cannot be drawn are wrong usage.
void add_size_flag(CLI::App& command, glm::ivec2& size);

// --graphics-memory SIZE, of surfaces; in bytes, 0 as the renderer has it.
CLI::Option* add_graphics_memory_flag(CLI::App& command, std::size_t& bytes);

// --view NAME; its help names anterior as what `view` is before.
CLI::Option* add_view_flag(CLI::App& command, render::View& view);

// --label N[,N...], of a mask.
CLI::Option* add_label_flag(CLI::App& command, std::vector<volume::LabelChoice>& labels, const std::string& help);

// Surfaces of the same vessels in one picture: the options of `ramus render` that say which, and how.
struct ComparisonFlags {
    std::optional<Comparison::Mode> mode;
    std::optional<std::vector<Compared>> surfaces;
    std::string mask;       // empty: the session's, or the tree's own voxels
    std::string mask_units; // empty: as the file says
    std::vector<volume::LabelChoice> labels;
    std::optional<double> share; // of the second surface, where two are blended
    std::optional<double> wipe;  // where the line between two is, of the picture's width
    bool skeleton = false, contacts = false, shortest_distances = false;
    int contact = 0; // to look at, from 1; 0: none
};

void add_comparison_flags(CLI::App& command, ComparisonFlags& flags);

// --colour-by deviation: from what, and up to where the colours go.
struct DeviationFlags {
    std::string from;                           // "cones", "iso" or a file; empty: the session's
    std::optional<double> most_mm, most_voxels; // none: the session's
};
void add_deviation_flags(CLI::App& command, DeviationFlags& flags);
// As the command lines that do the same; `mask_units`: of a file that is a mask, `mesh_axes`: of one that is a mesh,
// empty: as it says.
[[nodiscard]] std::vector<std::vector<std::string>>
command_lines(const DeviationFlags& flags, const std::string& mask_units, const std::string& mesh_axes);

// Throws CLI::ValidationError for what has no meaning without the other.
void check_comparison_flags(const CLI::App& command, const ComparisonFlags& flags);
// What was not given stays as it is.
void apply(const ComparisonFlags& flags, Marks& marks);

} // namespace ramus::app
