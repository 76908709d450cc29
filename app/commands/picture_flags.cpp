#include "app/commands/picture_flags.h"

#include "app/commands/command.h"
#include "app/commands/surface_flags.h"
#include "app/picture/figure_options.h"
#include "app/picture/slices.h"
#include "app/session/numbers.h"
#include "core/io/input_file.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/volumes/volume_file.h"
#include "render/renderer/drawn.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace ramus::app {

Result<render::Camera> camera_in(const std::string& text) {
    if (text.find('{') != std::string::npos) return render::parse_camera(text, "--camera");
    RAMUS_TRY(content, io::read_file(text, 1 << 20));
    return render::parse_camera(content, text);
}

void add_size_flag(CLI::App& command, glm::ivec2& size) {
    const std::string usual = std::to_string(size.x) + "x" + std::to_string(size.y);
    add_option_taking<std::string>(
        command, "--size", "WxH",
        [&size](const std::string& text) {
            const auto read = size_in(text);
            if (!read) throw CLI::ValidationError("--size", read.error().message());
            size = *read;
        },
        "Pixels of the picture (default " + usual + ")");
}

CLI::Option* add_graphics_memory_flag(CLI::App& command, std::size_t& bytes) {
    return add_memory_option(
        command, "--graphics-memory", bytes,
        "Most graphics memory for surfaces, as 800M or 4G (default 0: three quarters of what there is)");
}

constexpr const char* kViewHelp =
    "anterior (default), posterior, left, right, superior or inferior; or where to look from: +y, -y, -x, +x, +z, -z";

CLI::Option* add_view_flag(CLI::App& command, render::View& view) {
    std::map<std::string, render::View> views;
    for (const render::View one : render::kViews)
        views.emplace(render::name_of(one), one), views.emplace(render::axis_name_of(one), one);
    return add_option(command, "--view", "NAME", view, kViewHelp)
        ->transform(CLI::CheckedTransformer(views).description(""));
}

CLI::Option* add_view_flag(CLI::App& command, render::View& view, std::string& saved) {
    const auto take = [&view, &saved](const std::string& name) {
        const auto anatomical = render::view_named(name);
        view = anatomical.value_or(view);
        if (!anatomical) saved = name;
    };
    return add_option_taking<std::string>(command, "--view", "NAME", take,
                                          std::string(kViewHelp) + "; or a saved view of --session")
        ->check(expecting(" is no name", [](const std::string& name) { return !name.empty(); }));
}

CLI::Option* add_label_flag(CLI::App& command, std::vector<volume::LabelChoice>& labels, const std::string& help) {
    return add_option_taking<std::string>(
        command, "--label", "LABEL[,LABEL...]",
        [&labels](const std::string& list) {
            const auto found = label_list(list);
            if (!found)
                throw CLI::ValidationError("--label", list + " is not a list of whole numbers other than 0 and names");
            labels = *found;
        },
        help);
}

void add_comparison_flags(CLI::App& command, ComparisonFlags& flags) {
    add_option_taking<std::string>(
        command, "--compare", "MODE",
        [&flags](const std::string& name) {
            flags.mode = comparison_mode_named(name);
            if (!flags.mode)
                throw CLI::ValidationError("--compare",
                                           name + " is not side-by-side, blend, superimposed, wipe or off");
        },
        "Show surfaces of the same vessels together: side-by-side, blend, superimposed or wipe (one left of a line, "
        "the other right of it), in every picture of a --turntable or --sheet too");
    add_option_taking<std::string>(
        command, "--methods", "LIST",
        [&flags](const std::string& list) {
            flags.surfaces = surface_list(list);
            if (!flags.surfaces)
                throw CLI::ValidationError("--methods", list + " is not two or three of " + compared_names());
        },
        "With --compare: which surfaces, in this order (default cs,cones); iso is the isosurface of --mask, tree and "
        "paper are the convolution surface under either --blend");
    CLI::Option* mask = add_input(command, "--mask", "MASK", flags.mask,
                                  "Segmentation mask of the same vessels (" + io::readable_volume_extensions() +
                                      "; default: the tree's own voxels)");
    add_mask_units_flag(command, flags.mask_units, "--mask and of masks shown next to the tree");
    add_label_flag(command, flags.labels,
                   "Only these labels of the mask, by number or name, such as 1 or 1,portal_vein (default: all)")
        ->needs(mask);
    const auto is_share = [](const std::string& text) {
        double value = 0.0; // CLI11 reports words that are not numbers
        const bool is = !CLI::detail::lexical_cast(text, value) || (value >= 0.0 && value <= 1.0);
        return std::string(is ? "" : "goes from 0 to 1");
    };
    add_option(command, "--share", "SHARE", flags.share,
               "With --compare blend: how much of the second surface there is, from 0 to 1 (default 0.5)")
        ->check(is_share);
    add_option(command, "--wipe", "AT", flags.wipe,
               "With --compare wipe: where the line is, from 0 (left) to 1 (default 0.5)")
        ->check(is_share);
    command.add_flag("--skeleton", flags.skeleton, "Draw centerlines, with rings of the radius, over the vessels");
    command.add_flag(
        "--shortest-distances", flags.shortest_distances,
        "Draw the shortest distance from every lesion of the session to the nearest vessel of each system");
    command.add_flag(
        "--contacts", flags.contacts,
        "Mark where vessels press on each other without being connected there (`ramus info --contacts` lists "
        "them)");
    add_option(command, "--contact", "N", flags.contact,
               "Look at the N-th of them, the closest is the first; what --compare shows is then paper,tree unless "
               "--methods tells")
        ->check(CLI::Range(1, 1'000'000).description(""));
}

void add_deviation_flags(CLI::App& command, DeviationFlags& flags) {
    add_option(command, "--deviation-from", "cones|iso|FILE", flags.from,
               "Colour the surface by how far it lies from truncated cones, from the isosurface of --mask or, without "
               "one, of the tree's own voxels, or from a mesh or mask");
    const auto is_end = expecting(" is not a number above 0", [](const std::string& text) {
        double value = 0.0;
        return CLI::detail::lexical_cast(text, value) && value >= kLeastDeviation && value <= kMostDeviation;
    });
    CLI::Option* mm = add_option(command, "--scale-mm", "MAX", flags.most_mm,
                                 "With --colour-by deviation: where its colours end, in mm (default: where 99 % of the "
                                 "distances lie below)")
                          ->check(is_end);
    add_option(command, "--scale-voxels", "N", flags.most_voxels, "The same in diagonals of the mask's voxels")
        ->check(is_end)
        ->excludes(mm);
}

std::vector<std::vector<std::string>> command_lines(const DeviationFlags& flags, const std::string& mask_units,
                                                    const std::string& mesh_axes) {
    std::vector<std::vector<std::string>> lines;
    if (!flags.from.empty()) lines.push_back({"deviation-from", flags.from});
    if (!flags.from.empty() && !mask_units.empty() && io::is_volume(flags.from))
        lines.back().insert(lines.back().end(), {"--units", mask_units});
    if (!flags.from.empty() && !mesh_axes.empty() && io::names_mesh(flags.from))
        lines.back().insert(lines.back().end(), {"--mesh-orientation", mesh_axes});
    if (flags.most_mm) lines.push_back({"deviation-scale", exact_text(*flags.most_mm), "mm"});
    if (flags.most_voxels) lines.push_back({"deviation-scale", exact_text(*flags.most_voxels), "voxels"});
    return lines;
}

void check_comparison_flags(const CLI::App& command, const ComparisonFlags& flags) {
    const bool off = !flags.mode || *flags.mode == Comparison::Mode::kOff;
    const bool measures = command.get_option("--deviation-from")->count() > 0;
    for (const char* name : {"--methods", "--mask", "--label"})
        if (off && command.get_option(name)->count() > 0 && (!measures || name == std::string("--methods")))
            throw CLI::ValidationError(name,
                                       "has a meaning only with --compare" +
                                           std::string(name == std::string("--methods") ? "" : " or --deviation-from"));
    if (flags.share && (off || *flags.mode != Comparison::Mode::kBlend))
        throw CLI::ValidationError("--share", "has a meaning only with --compare blend");
    if (flags.wipe && (off || *flags.mode != Comparison::Mode::kWipe))
        throw CLI::ValidationError("--wipe", "has a meaning only with --compare wipe");
}

void apply(const ComparisonFlags& flags, Marks& marks) {
    Comparison& comparison = marks.comparison;
    if (flags.mode) comparison.mode = *flags.mode;
    if (flags.contact > 0 && flags.mode) comparison.surfaces = {Compared::kMerged, Compared::kApart};
    if (flags.surfaces) comparison.surfaces = *flags.surfaces;
    if (!flags.mask.empty()) {
        comparison.mask = std::filesystem::absolute(flags.mask).lexically_normal().string();
        comparison.mask_units = flags.mask_units;
        comparison.labels = flags.labels;
    }
    if (flags.share) comparison.blend = *flags.share;
    if (flags.wipe) comparison.wipe = *flags.wipe;
    if (flags.skeleton) marks.skeleton = true;
    if (flags.contacts) marks.contact_marks = true;
    if (flags.shortest_distances) marks.shortest_distances = true;
}

CLI::Option* add_window_flag(CLI::App& command, std::optional<slice::Window>& window) {
    const auto take = [&window](const std::string& word) {
        if (word != "auto") window = window_in(word);
    };
    return add_option_taking<std::string>(command, "--window", "WIDTH,LEVEL|NAME", take,
                                          "Values from black to white: abdomen, liver, lung, bone, angiography, or "
                                          "their width and level (default: "
                                          "what the file proposes, or auto: from the values)")
        ->check(expecting(" is neither a window's name nor WIDTH,LEVEL",
                          [](const std::string& word) { return word == "auto" || window_in(word).has_value(); }));
}

void add_scan_flags(CLI::App& command, ScanFlags& flags) {
    CLI::Option* scan = add_input(command, "--scan", "VOLUME", flags.scans,
                                  "Slices of this scan, or tints of the labels of a segmentation; may be repeated");
    scan->allow_extra_args(false);
    add_option(command, "--slice", "NAME[=PLACE]", flags.slices,
               "Show the axial, coronal or sagittal slice among the vessels, at a place in mm: axial=12.5; or the "
               "oblique one across a branch: oblique=12@0.5; may be repeated")
        ->allow_extra_args(false)
        ->check(expecting(" is not the name of a slice, or NAME=PLACE", [](const std::string& word) {
            return slice::direction_named(word.substr(0, word.find('='))).has_value();
        }));
    add_option(command, "--cut-away", "NAME", flags.cut_away, "Leave out what lies before this slice")
        ->check(expecting(" is not the name of a slice",
                          [](const std::string& word) { return slice::direction_named(word).has_value(); }));
    add_option(command, "--layout", "NAME", flags.layout,
               "Divide the picture: slices (the vessels and three slices), large, or one slice alone: axial, coronal, "
               "sagittal, oblique")
        ->check(expecting(" is not a layout", [](const std::string& word) { return layout_named(word).has_value(); }));
    add_window_flag(command, flags.window)->needs(scan);
}

void apply(const ScanFlags& flags, SliceViews& views) {
    if (!flags.layout.empty()) views.layout = *layout_named(flags.layout);
}

std::vector<std::vector<std::string>> command_lines(const ScanFlags& flags) {
    std::vector<std::vector<std::string>> lines;
    for (const std::string& file : flags.scans) lines.push_back({"scan", file});
    if (flags.window)
        lines.push_back({"window", exact_text(flags.window->width) + "," + exact_text(flags.window->level)});
    for (const std::string& word : flags.slices) {
        const auto equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const bool oblique = slice::direction_named(name) == slice::Direction::kOblique;
        if (equals != std::string::npos && oblique)
            lines.push_back({"slice-across", word.substr(equals + 1)});
        else if (equals != std::string::npos)
            lines.push_back({"slice", name, word.substr(equals + 1)});
        lines.push_back({"slice-plane", name, "on"});
    }
    if (!flags.cut_away.empty()) lines.push_back({"cut-away", flags.cut_away});
    return lines;
}

} // namespace ramus::app
