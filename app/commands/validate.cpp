// `ramus validate TREE`: the paper's validation (section VII) of the surface of a tree, made here or by another
// program.
#include "app/commands/deviation_report.h"
#include "app/commands/inputs.h"
#include "app/commands/picture_flags.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/commands/surface_input.h"
#include "app/session/numbers.h"
#include "app/session/of_file.h"
#include "core/io/json_text.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/output_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/measure/deviation/deviation.h"
#include "core/validate/validation.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

struct ValidateFlags {
    SurfaceFlags surface;
    MaskInput labels;
    std::string tree, mask, mesh;
    std::filesystem::path report; // a folder; empty: none
    bool json = false;
};

struct Findings {
    measure::DeviationStatistics to_cones;
    std::optional<measure::DeviationStatistics> to_mask;
    std::optional<double> half_voxel_mm;
    validate::Validation validation;
};

ordered_json place_of(const glm::dvec3& at) { return {at.x + 0.0, at.y + 0.0, at.z + 0.0}; } // no negative zeros

ordered_json constrictions_json(const std::vector<validate::Constriction>& constrictions) {
    ordered_json list = ordered_json::array();
    for (const validate::Constriction& one : constrictions)
        list.push_back({{"branch", one.branch},
                        {"at", place_of(one.at)},
                        {"expected_radius_mm", one.expected_radius_mm},
                        {"radius_mm", one.radius_mm}});
    return list;
}

ordered_json questions_json(const validate::Validation& found) {
    ordered_json lost = ordered_json::array(), parts = ordered_json::array(), merged = ordered_json::array();
    for (const validate::Lost& one : found.lost)
        lost.push_back({{"branch", one.branch}, {"at", place_of(one.at)}, {"length_mm", one.length_mm}});
    for (const validate::FalsePart& one : found.false_parts)
        parts.push_back({{"at", place_of(one.at)}, {"length_mm", one.length_mm}});
    for (const validate::Merged& one : found.merged)
        merged.push_back({{"branches", one.branches}, {"at", place_of(one.at)}, {"gap_mm", one.gap_mm}});
    return {{"lost", std::move(lost)},
            {"false", std::move(parts)},
            {"merged", std::move(merged)},
            {"constrictions", constrictions_json(found.constrictions)}};
}

ordered_json radius_error_json(const validate::RadiusError& error) {
    if (error.places == 0) return {{"median", nullptr}, {"p95", nullptr}, {"places", 0}};
    return {{"median", error.median},
            {"p95", error.p95},
            {"places", error.places},
            {"flat", {{"median", error.flat_median}, {"p95", error.flat_p95}}}};
}

ordered_json json_of(const ValidateFlags& flags, const Findings& found) {
    ordered_json json;
    json["tree"] = flags.tree;
    json["surface"] = flags.mesh.empty() ? "made of the tree" : flags.mesh;
    json["distances"]["to_cones"] = deviation_json(found.to_cones);
    json["distances"]["to_mask"] = nullptr;
    if (found.to_mask) {
        json["distances"]["to_mask"] = deviation_json(*found.to_mask);
        json["distances"]["to_mask"]["threshold_mm"] = *found.half_voxel_mm;
    }
    json["radius_error"] = radius_error_json(found.validation.radius_error);
    json["questions"] = questions_json(found.validation);
    json["smoothed_away"] = constrictions_json(found.validation.smoothed_away);
    return json;
}

Result<void> write_text(const std::filesystem::path& file, const std::string& text) {
    RAMUS_TRY(output, io::OutputFile::create(file));
    output.write(text);
    return output.commit();
}

// What the radius is along each branch, for plots.
std::string radii_csv(const std::vector<validate::RadiusPlace>& radii) {
    std::string text =
        "branch,along_mm,x,y,z,input_radius_mm,smoothed_radius_mm,surface_radius_mm,flat_radius_mm,alone\r\n";
    for (const validate::RadiusPlace& place : radii) {
        text += std::to_string(place.branch);
        for (const double value : {place.along_mm, place.at.x, place.at.y, place.at.z, place.input_mm,
                                   place.expected_mm, place.surface_mm, place.flat_mm})
            text += "," + ordered_json(value).dump();
        text += place.alone ? ",yes\r\n" : ",no\r\n";
    }
    return text;
}

Result<void> write_report(const std::filesystem::path& folder, const ordered_json& json, const Findings& found) {
    if (auto written = write_text(folder / "validation.json", io::printed_json(json) + "\n"); !written) return written;
    return write_text(folder / "radii.csv", radii_csv(found.validation.radii));
}

Result<Findings> look(const ValidateFlags& flags) {
    RAMUS_TRY(tree, load_tree(flags.tree, flags.surface));
    const mesh::SurfaceOptions& options = flags.surface.surface;
    RAMUS_TRY(loaded, flags.mesh.empty() ? of_file(surface_of_tree(tree, flags.surface), flags.tree)
                                         : of_file(load_mesh(flags.mesh), flags.mesh));
    const mesh::TriangleMesh& surface = loaded.mesh;
    if (surface.triangles.empty()) return fail("there is no surface in it", flags.mesh);
    Findings found;
    RAMUS_TRY(
        validation, with_progress("validation", [&](Job& job) {
            return validate::validate(tree, surface, {options.smooth_passes, options.width, options.threads}, job);
        }));
    found.validation = std::move(validation);
    SurfaceFlags of_cones = flags.surface;
    of_cones.surface.method = mesh::Method::kTruncatedCones;
    RAMUS_TRY(cones, surface_of_tree(tree, of_cones));
    LargeArray<double> distances = measure::deviations(surface, cones.mesh, options.threads);
    found.to_cones = measure::statistics_of(distances, {});
    if (flags.mask.empty()) return found;
    RAMUS_TRY(mask, surface_of_mask(flags.mask, flags.surface, flags.labels));
    distances = measure::deviations(surface, mask.mesh, options.threads);
    found.half_voxel_mm = mask.half_voxel_mm;
    found.to_mask = measure::statistics_of(distances, mask.half_voxel_mm);
    return found;
}

std::string at_text(const glm::dvec3& at) {
    return rounded(at.x + 0.0) + ", " + rounded(at.y + 0.0) + ", " + rounded(at.z + 0.0) + " mm";
}

// A heading with how many there are, and a line for each of the first.
template <class List, class Line> void print_list(const std::string& heading, const List& list, const Line& line) {
    constexpr std::size_t kMostListed = 20; // a person reads no more; JSON has them all
    std::cout << heading << ": " << (list.empty() ? "none" : grouped(list.size())) << '\n';
    const std::size_t listed = std::min(list.size(), kMostListed);
    for (std::size_t i = 0; i < listed; ++i) std::cout << "    " << line(list[i]) << '\n';
    if (listed < list.size()) std::cout << "    and " << grouped(list.size() - listed) << " more, which --json lists\n";
}

void print(const Findings& found) {
    const validate::Validation& validation = found.validation;
    print_list("lost branches", validation.lost, [](const validate::Lost& one) {
        return "branch " + std::to_string(one.branch) + " at " + at_text(one.at) + ", " + length_text(one.length_mm) +
               " long";
    });
    print_list("false branches", validation.false_parts, [](const validate::FalsePart& one) {
        return "at " + at_text(one.at) + ", " + length_text(one.length_mm) + " long";
    });
    print_list("merged branches", validation.merged, [](const validate::Merged& one) {
        return "branch " + std::to_string(one.branches[0]) + " with " + std::to_string(one.branches[1]) + " at " +
               at_text(one.at) + (one.gap_mm < 0.0 ? ", overlap " : ", gap ") + length_text(std::abs(one.gap_mm));
    });
    print_list("changed constrictions", validation.constrictions, [](const validate::Constriction& one) {
        return "branch " + std::to_string(one.branch) + " at " + at_text(one.at) + ", radius " +
               length_text(one.radius_mm) + " instead of " + length_text(one.expected_radius_mm);
    });
    std::cout << "narrow places that smoothing changes by more than 10 %: " << grouped(validation.smoothed_away.size())
              << '\n';
    const validate::RadiusError& error = validation.radius_error;
    if (error.places > 0)
        std::cout << "radius away from joints: median error " << digits(100.0 * error.median) << " %, 95th percentile "
                  << digits(100.0 * error.p95) << " %; of flat triangles " << digits(100.0 * error.flat_median)
                  << " % and " << digits(100.0 * error.flat_p95) << " %\n";
    std::cout << deviation_text("surface to truncated cones", found.to_cones, {});
    if (found.to_mask) std::cout << deviation_text("surface to isosurface", *found.to_mask, found.half_voxel_mm);
}

Result<int> run_validate(const ValidateFlags& flags) {
    if (!flags.report.empty()) {
        std::error_code error;
        std::filesystem::create_directories(flags.report, error);
        if (error || !std::filesystem::is_directory(flags.report))
            return fail("the folder cannot be made", flags.report.string(), "give the name of a folder");
        for (const auto& input : {flags.tree, flags.mesh, flags.mask}) io::note_input(input);
        for (const char* name : {"validation.json", "radii.csv"})
            if (auto can = io::check_output(flags.report / name); !can) return tl::unexpected(can.error());
    }
    RAMUS_TRY(found, look(flags));
    const ordered_json json = json_of(flags, found);
    if (!flags.report.empty())
        if (auto written = write_report(flags.report, json, found); !written) return tl::unexpected(written.error());
    if (flags.json)
        std::cout << io::printed_json(json) << '\n';
    else
        print(found);
    return kDone;
}

} // namespace

void register_validate(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<ValidateFlags>();
    CLI::App* command = add_command(
        app, "validate",
        "Hold a surface against its tree: branches that are lost, false or merged, constrictions, radii, distances");
    add_option(*command, "TREE", "", flags->tree, "Vessel tree")->required();
    add_option(*command, "--surface", "MESH", flags->mesh,
               "The surface, from any program (" + io::readable_mesh_extensions() + "); without it, that of ramus");
    CLI::Option* mask = add_option(*command, "--mask", "MASK", flags->mask,
                                   "Segmentation mask of the same vessels (" + io::readable_volume_extensions() +
                                       "): distances to its isosurface");
    add_mask_units_flag(*command, flags->labels.units, "--mask")->needs(mask);
    add_label_flag(*command, flags->labels.labels, "Labels of the mask that are these vessels (default: all)")
        ->needs(mask);
    add_option(*command, "--report", "FOLDER", flags->report,
               "Write what was found as validation.json, and the radii along all branches as radii.csv; the folder is "
               "made if need be");
    command->add_flag("--json", flags->json, "Print what was found as one JSON object");
    add_surface_flags(*command, flags->surface);
    command->callback([flags, &chosen] { chosen = [flags] { return run_validate(*flags); }; });
}

} // namespace ramus::app
