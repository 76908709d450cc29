// Options of commands that draw pictures. The objects that parsing writes to must live as long as the command.
#pragma once

#include "app/session/session.h"
#include "core/slice/window.h"
#include "render/scene/camera.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

// Parses the value of --camera: JSON, or the name of a file with it.
[[nodiscard]] Result<render::Camera> camera_in(const std::string& text);

// Adds --size WxH, pixels. The value of `size` is the default, which the help names. Sizes that cannot be drawn are
// wrong usage.
void add_size_flag(CLI::App& command, glm::ivec2& size);

// Adds --graphics-memory SIZE, the limit for surfaces in bytes; 0: the renderer's own limit.
CLI::Option* add_graphics_memory_flag(CLI::App& command, std::size_t& bytes);

// Adds --view NAME. `view` must be anterior, the default that the help names.
CLI::Option* add_view_flag(CLI::App& command, render::View& view);
// The same, where a session may be given: `saved` gets any other name, that of a saved view.
CLI::Option* add_view_flag(CLI::App& command, render::View& view, std::string& saved);

// Adds --label LABEL[,LABEL...], the labels of a mask, by number or name.
CLI::Option* add_label_flag(CLI::App& command, std::vector<volume::LabelChoice>& labels, const std::string& help);

// The options of `ramus render` that compare surfaces of the same vessels in one picture. No value or empty: not given.
struct ComparisonFlags {
    std::optional<Comparison::Mode> mode;
    std::optional<std::vector<Compared>> surfaces;
    std::string mask;       // empty: the session's mask, or one made of the tree
    std::string mask_units; // empty: as the file says
    std::vector<volume::LabelChoice> labels;
    std::optional<double> share; // of the second surface when two are blended, 0 to 1
    std::optional<double> wipe;  // position of the line between two surfaces, 0 (left) to 1 (right)
    bool skeleton = false, contacts = false, shortest_distances = false;
    int contact = 0; // the contact to look at, from 1; 0: none
};

void add_comparison_flags(CLI::App& command, ComparisonFlags& flags);

// The options of --colour-by deviation: the other surface, and the end of the colour scale.
struct DeviationFlags {
    std::string from;                           // "cones", "iso" or a file; empty: as in the session
    std::optional<double> most_mm, most_voxels; // none: as in the session
};
void add_deviation_flags(CLI::App& command, DeviationFlags& flags);
// The commands of app/actions that set the same. `mask_units`: the unit of a file that is a mask; `mesh_axes`: the axes
// of a file that is a mesh; empty: as the file says.
[[nodiscard]] std::vector<std::vector<std::string>>
command_lines(const DeviationFlags& flags, const std::string& mask_units, const std::string& mesh_axes);

// Adds --window WIDTH,LEVEL|NAME. None: what the file proposes, otherwise from the values (core/slice/window.h).
CLI::Option* add_window_flag(CLI::App& command, std::optional<slice::Window>& window);

// The options about scans and slices.
struct ScanFlags {
    std::vector<std::string> scans, slices; // files; "axial", "axial=12.5", "oblique=12@0.5"
    std::optional<slice::Window> window;
    std::string cut_away, layout;
};
void add_scan_flags(CLI::App& command, ScanFlags& flags);
// Sets the layout, which determines the size of the part for the tree.
void apply(const ScanFlags& flags, SliceViews& views);
// The commands of app/actions that do the rest.
[[nodiscard]] std::vector<std::vector<std::string>> command_lines(const ScanFlags& flags);

// Throws CLI::ValidationError if an option is given without the option that it needs.
void check_comparison_flags(const CLI::App& command, const ComparisonFlags& flags);
// Sets the given options in `marks`, and leaves all others unchanged.
void apply(const ComparisonFlags& flags, Marks& marks);

} // namespace ramus::app
