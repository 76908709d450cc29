// `ramus compare A B`: measures the distances between two surfaces (the paper's section VII-B).
#include "app/commands/deviation_report.h"
#include "app/commands/inputs.h"
#include "app/commands/picture_flags.h"
#include "app/commands/printed_report.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/commands/surface_input.h"
#include "app/session/numbers.h"
#include "core/base/stopwatch.h"
#include "core/io/standard_input.h"
#include "core/measure/deviation/deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace ramus::app {

namespace {

struct CompareFlags {
    SurfaceFlags surface;
    MaskInput mask;
    std::array<std::string, 2> files, mesh_axes;
    std::optional<double> threshold_mm;
    bool json = false;
};

// The distances of each surface's vertices from the other surface, A to B and B to A.
struct Deviations {
    std::array<measure::DeviationStatistics, 2> ways;
    std::optional<double> threshold_mm;
    double seconds = 0.0;
};

Deviations deviations(const std::array<SurfaceInput, 2>& inputs, const CompareFlags& flags) {
    Deviations found;
    found.threshold_mm = flags.threshold_mm;
    for (const SurfaceInput& input : inputs)
        if (!found.threshold_mm && input.half_voxel_mm) found.threshold_mm = input.half_voxel_mm;
    const Stopwatch watch;
    for (std::size_t way = 0; way < 2; ++way) {
        LargeArray<double> distances =
            measure::deviations(inputs[way].mesh, inputs[1 - way].mesh, flags.surface.surface.threads);
        found.ways[way] = measure::statistics_of(distances, found.threshold_mm);
    }
    found.seconds = watch.seconds();
    return found;
}

nlohmann::ordered_json input_json(const std::string& file, const SurfaceInput& input,
                                  const measure::SurfaceSize& size) {
    nlohmann::ordered_json json = {{"file", io::input_name(file)},
                                   {"vertices", input.mesh.positions.size()},
                                   {"triangles", input.mesh.triangles.size()}};
    json.update(size_json(size));
    return json;
}

// Parses "LPS", for both meshes, or "LPS,RAS", for A and for B.
std::optional<std::array<std::string, 2>> two_axes(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto first = io::slicer_space(text.substr(0, comma));
    const auto second = comma == std::string::npos ? first : io::slicer_space(text.substr(comma + 1));
    if (!first || !second) return {};
    return std::array{first->letters(), second->letters()};
}

// Warns if a mesh is rotated by half a turn against the other surface. Of two meshes, the first is checked that does
// not state its axes.
void warn_of_axes(const CompareFlags& flags, const std::array<SurfaceInput, 2>& inputs) {
    if (std::ranges::none_of(inputs,
                             [](const auto& input) { return input.claims.orientation == tree::SaidBy::kPerson; }))
        for (std::size_t i = 0; i < 2; ++i) warn_of_stated_axes(flags.files[i], inputs[i], flags.mesh_axes[i]);
    const auto states = [](const SurfaceInput& input) { return input.claims.orientation == tree::SaidBy::kFile; };
    for (std::size_t i = 0; i < 2; ++i) {
        const SurfaceInput &mesh = inputs[i], &other = inputs[1 - i];
        if (!mesh.is_mesh || (other.is_mesh && (states(mesh) || (i == 1 && !states(other))))) continue;
        std::string option = other_axes_option(flags.mesh_axes[i]);
        if (other.is_mesh && !states(other)) option += "," + (flags.mesh_axes[1].empty() ? "RAS" : flags.mesh_axes[1]);
        warn_of_half_turn(flags.files[i], mesh, {render::bounds_of(other.mesh), other.claims.orientation}, option);
    }
}

Result<int> run_compare(const CompareFlags& flags) {
    std::array<SurfaceInput, 2> inputs;
    std::array<measure::SurfaceSize, 2> sizes;
    for (std::size_t i = 0; i < 2; ++i) {
        RAMUS_TRY(input, load_surface(flags.files[i], flags.surface, flags.mask, flags.mesh_axes[i]));
        if (input.mesh.triangles.empty()) return fail("there is no surface in it", flags.files[i]);
        inputs[i] = std::move(input);
        sizes[i] = measure::size_of(inputs[i].mesh);
    }
    warn_of_axes(flags, inputs);
    const Deviations found = deviations(inputs, flags);
    const double hausdorff = std::max(found.ways[0].max, found.ways[1].max);
    const double hausdorff_95 = std::max(found.ways[0].percentile_95, found.ways[1].percentile_95);
    say(flags.surface, "distances in " + seconds_text(found.seconds));
    const tree::Claims& claims = inputs[inputs[0].claims.has_unit() ? 1 : 0].claims; // those without a unit, if any
    if (flags.json) {
        nlohmann::ordered_json json = deviation_json(found.ways[0]);
        json.update(size_json(sizes[0]));
        json["threshold_mm"] = nullptr;
        if (found.threshold_mm) json["threshold_mm"] = *found.threshold_mm;
        json["back"] = deviation_json(found.ways[1]);
        json["back"].update(size_json(sizes[1]));
        json["units"] = claims.unit_word();
        json["hausdorff"] = hausdorff;
        json["hausdorff_95"] = hausdorff_95;
        json["a"] = input_json(flags.files[0], inputs[0], sizes[0]);
        json["b"] = input_json(flags.files[1], inputs[1], sizes[1]);
        json["seconds"] = found.seconds;
        std::cout << printed_report(std::move(json)) << '\n';
        return kDone;
    }
    const Lengths lengths(claims);
    for (std::size_t i = 0; i < 2; ++i)
        std::cout << io::input_name(flags.files[i]) << ": "
                  << counted(inputs[i].mesh.positions.size(), "vertex", "vertices") << ", "
                  << counted(inputs[i].mesh.triangles.size(), "triangle", "triangles") << ", area "
                  << lengths.area(sizes[i].area_mm2) + ", "
                  << (sizes[i].volume_mm3 ? "volume " + lengths.volume(*sizes[i].volume_mm3) : "not closed") << '\n';
    std::cout << lengths.worded(deviation_text("A to B", found.ways[0], found.threshold_mm) +
                                deviation_text("B to A", found.ways[1], found.threshold_mm))
              << "Hausdorff distance " << lengths.text(hausdorff, 4) << ", its 95th percentile "
              << lengths.text(hausdorff_95, 4) << '\n';
    return kDone;
}

} // namespace

void register_compare(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<CompareFlags>();
    CLI::App* command = add_command(
        app, "compare", "How far the vertices of one surface are from another surface, and the other way round");
    add_input(*command, "A", "", flags->files[0], "Surface: " + surface_input_kinds())->required();
    add_input(*command, "B", "", flags->files[1], "The surface that A is compared with")->required();
    add_option(*command, "--threshold", "MM", flags->threshold_mm,
               "Say how many of the distances are above this (default, with a mask: half the diagonal of its voxels)")
        ->check(expecting(" is not a number of mm from 0 on", [](const std::string& text) {
            double value = 0.0;
            return CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0.0;
        }));
    add_label_flag(*command, flags->mask.labels, "Labels of the mask that are these vessels (default: all)");
    add_mask_units_flag(*command, flags->mask.units, "a mask");
    add_option_taking<std::string>(
        *command, "--mesh-orientation", "LPS|RAS[,LPS|RAS]",
        [flags](const std::string& text) { flags->mesh_axes = *two_axes(text); },
        "Axes of meshes that do not state them, of both or of A and of B (default RAS)")
        ->check(expecting(" is not LPS, RAS or two of them, as LPS,RAS", two_axes));
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    add_surface_flags(*command, flags->surface);
    command->callback([flags, &chosen] { chosen = [flags] { return run_compare(*flags); }; });
}

} // namespace ramus::app
