// `ramus resect --organ MASK --tree TREE`: what resections remove of an organ, what remains and how well it is
// supplied, how far lesions are from the surface, and which vessels are cut.
#include "app/commands/command.h"
#include "app/commands/inputs.h"
#include "app/commands/organ_case.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/resect_input.h"
#include "app/commands/subcommands.h"
#include "app/session/numbers.h"
#include "core/base/printable.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/output_file.h"
#include "core/io/run_inputs.h"
#include "core/io/volumes/label_map_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/organ/resect/cut_vessels.h"
#include "core/organ/resect/lesion_margin.h"
#include "core/organ/resect/removal.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

namespace ramus::app {

namespace {

struct ResectFlags : OrganFlags {
    ResectionFlags resections;
    std::string output;
    bool json = false;
};

// All that is computed.
struct ResectPlan {
    std::vector<std::string> kinds; // of the resections
    organ::Removal removal;
    std::vector<organ::VoxelLesion> lesions;
    std::vector<organ::Margin> margins;    // by lesion
    std::vector<organ::CutVessel> vessels; // in the organ
    std::size_t outside = 0;               // places where a vessel passes the surface outside of the organ
    organ::PartRemnant remnant;            // of the functional organ
    double functional_kept = 0.0;          // voxels
};

bool is_mesh_output(const std::string& file) { return io::mesh_format(file).has_value(); }

Result<void> check_output_file(const std::string& file) {
    if (file.empty()) return {};
    if (is_mesh_output(file)) return io::check_output(file);
    auto possible = io::check_label_map_output(file);
    if (!possible && possible.error().hint.find(".seg.nrrd") != std::string::npos)
        possible.error().hint += ", or a mesh: " + io::writable_mesh_extensions();
    return possible;
}

Result<organ::Removal> removal_of(const OrganCase& read, const std::vector<organ::Resection>& resections) {
    return with_progress(
        "resection", [&](Job& job) { return organ::remove_from(read.organ, resections, JobRange(job, 0.0F, 1.0F)); },
        kNothingWritten);
}

Result<ResectPlan> plan_of(const OrganCase& read, const ResectFlags& flags) {
    RAMUS_TRY(systems, supplies_by_system(read, flags));
    RAMUS_TRY(named, resections_of(read, flags, flags.resections, systems));
    ResectPlan plan;
    std::vector<organ::Resection> resections;
    for (NamedResection& one : named) {
        plan.kinds.push_back(one.kind);
        resections.push_back(std::move(one.resection));
    }
    RAMUS_TRY(removal, removal_of(read, resections));
    plan.removal = std::move(removal);
    if (!flags.lesions.empty()) {
        RAMUS_TRY(lesions, load_lesions(flags.lesions, flags));
        plan.lesions = std::move(lesions);
        plan.margins = organ::margins_of(read.organ, resections, plan.removal.surface, plan.lesions);
    }
    plan.vessels = organ::vessels_cut(read.organ, read.tree, resections);
    plan.outside = std::erase_if(plan.vessels, [](const organ::CutVessel& vessel) { return !vessel.in_organ; });
    for (const measure::Cut& cut : flags.resections.cuts) plan.vessels.push_back(organ::vessel_at(read.tree, cut));
    organ::sort_vessels(plan.vessels);
    const std::vector<measure::Cut> cuts = organ::cuts_of(plan.vessels);
    plan.remnant =
        organ::remnant_of(systems.parts, measure::lost_spans(read.tree, cuts), read.functional, plan.removal.kept);
    for (std::size_t voxel = 0; voxel < read.functional.size(); ++voxel)
        plan.functional_kept += read.functional[voxel] != 0 ? static_cast<double>(plan.removal.kept[voxel]) : 0.0;
    return plan;
}

nlohmann::ordered_json place_json(const glm::dvec3& place) { return {place.x, place.y, place.z}; }

nlohmann::ordered_json margins_json(const ResectPlan& plan) {
    nlohmann::ordered_json margins = nlohmann::ordered_json::array();
    for (std::size_t n = 0; n < plan.margins.size(); ++n) {
        const organ::Margin& margin = plan.margins[n];
        nlohmann::ordered_json one = {{"lesion", plan.lesions[n].name},
                                      {"volume_ml", plan.lesions[n].solid->voxels().volume_ml()},
                                      {"removed", organ::name_of(margin.removed)},
                                      {"mm", nullptr},
                                      {"at", nullptr},
                                      {"to", nullptr}};
        if (margin.distance_mm) {
            one["mm"] = *margin.distance_mm;
            one["at"] = place_json(margin.on_lesion);
            one["to"] = place_json(margin.on_surface);
        }
        margins.push_back(std::move(one));
    }
    return margins;
}

nlohmann::ordered_json vessels_json(const OrganCase& read, const ResectPlan& plan) {
    nlohmann::ordered_json vessels = nlohmann::ordered_json::array();
    for (const organ::CutVessel& vessel : plan.vessels) {
        const int system = read.tree.branches[static_cast<std::size_t>(vessel.place.branch)].system;
        vessels.push_back({{"system", name_of_system(read.tree, system)},
                           {"branch", vessel.place.branch},
                           {"fraction", vessel.place.fraction},
                           {"at", place_json(vessel.at)},
                           {"diameter_mm", vessel.diameter_mm},
                           {"angle_deg", vessel.angle_deg}});
    }
    return vessels;
}

nlohmann::ordered_json resection_report(const OrganCase& read, const ResectPlan& plan, const ResectFlags& flags) {
    const double ml = read.organ.voxel_ml();
    const auto whole = static_cast<double>(read.organ.count());
    nlohmann::ordered_json systems = nlohmann::ordered_json::array();
    for (std::size_t s = 0; s < plan.remnant.lost.size(); ++s)
        systems.push_back({{"name", name_of_system(read.tree, static_cast<int>(s))},
                           {"role", read.roles[s] == organ::Role::kDrains ? "drains" : "supplies"},
                           {"lost_ml", plan.remnant.lost[s] * ml}});
    return {{"organ_ml", whole * ml},
            {"functional_ml", static_cast<double>(read.functional_voxels) * ml},
            {"voxels", read.organ.count()},
            {"unit", read.claims.unit_word()},
            {"parts", read.parts},
            {"by", organ::name_of(flags.supply.rule)},
            {"resections", plan.kinds},
            {"removed_ml", plan.removal.removed_voxels * ml},
            {"remnant_ml", (whole - plan.removal.removed_voxels) * ml},
            {"remnant_percent", 100.0 * (1.0 - plan.removal.removed_voxels / whole)},
            {"functional_remnant_ml", plan.functional_kept * ml},
            {"area_mm2", plan.removal.area_mm2},
            {"margins", margins_json(plan)},
            {"vessels", vessels_json(read, plan)},
            {"vessels_outside", plan.outside},
            {"systems", systems},
            {"remnant",
             {{"supplied_ml", plan.remnant.supplied * ml},
              {"drained_ml", plan.remnant.drained * ml},
              {"congested_ml", plan.remnant.congested() * ml},
              {"unsupplied_ml", plan.remnant.unsupplied() * ml}}}};
}

constexpr std::array<const char*, 3> kRemovedWords{"not removed", "removed in part", "removed"};

void print_margins(const ResectPlan& plan, const Lengths& lengths) {
    for (std::size_t n = 0; n < plan.margins.size(); ++n) {
        const organ::Margin& margin = plan.margins[n];
        std::cout << "margin        " << printable(plan.lesions[n].name) << ": "
                  << (margin.distance_mm ? lengths.text(*margin.distance_mm) : "no surface in the organ") << ", "
                  << kRemovedWords[static_cast<std::size_t>(margin.removed)] << '\n';
    }
}

void print_resection(const OrganCase& read, const ResectPlan& plan) {
    const double mm3 = 1000.0 * read.organ.voxel_ml();
    const Lengths lengths(read.claims);
    const auto volume = [&](double voxels) { return lengths.volume(voxels * mm3); };
    const auto whole = static_cast<double>(read.organ.count());
    std::cout << "organ         " << volume(whole) << ", functional "
              << volume(static_cast<double>(read.functional_voxels)) << '\n'
              << "removed       " << volume(plan.removal.removed_voxels) << '\n'
              << "remnant       " << volume(whole - plan.removal.removed_voxels) << ", "
              << rounded(100.0 * (1.0 - plan.removal.removed_voxels / whole)) << " % of the organ; functional "
              << volume(plan.functional_kept) << '\n'
              << "              supplied " << volume(plan.remnant.supplied) << ", drained "
              << volume(plan.remnant.drained) << ", congested " << volume(plan.remnant.congested()) << '\n'
              << "surface       " << lengths.area(plan.removal.area_mm2) << '\n';
    print_margins(plan, lengths);
    std::cout << "vessels cut   " << plan.vessels.size() << '\n';
    for (const organ::CutVessel& vessel : plan.vessels) {
        const int system = read.tree.branches[static_cast<std::size_t>(vessel.place.branch)].system;
        const std::string name = name_of_system(read.tree, system);
        std::cout << "              " << (name.empty() ? "" : printable(name) + ", ") << "branch "
                  << vessel.place.branch << " at " << rounded(vessel.place.fraction) << ": diameter "
                  << lengths.text(vessel.diameter_mm) << ", angle " << digits(vessel.angle_deg) << "°\n";
    }
    if (plan.outside > 0)
        std::cerr << "ramus: vessels pass the surface at " << counted(plan.outside, "place", "places")
                  << " outside of the organ, which do not count as cut\n";
}

Result<void> write_resection(const OrganCase& read, ResectPlan& plan, const std::string& output) {
    if (output.empty()) return {};
    if (!is_mesh_output(output)) {
        const auto label_of = [&](std::size_t number) -> std::uint16_t {
            return plan.removal.kept[number] >= 0.5F ? 1 : 2;
        };
        return write_case_labels(read, {"remnant", "removed"}, label_of, output);
    }
    if (plan.removal.surface.triangles.empty())
        return fail("there is no surface of the resection in the organ", output, "write a label map instead");
    io::MeshNames names;
    names.name = "resection";
    names.claims = read.claims;
    return io::write_mesh(organ::mesh_of(plan.removal.surface), output, names);
}

Result<int> run_resect(const ResectFlags& flags) {
    if (auto possible = check_output_file(flags.output); !possible) return tl::unexpected(possible.error());
    for (const auto* files : {&flags.resections.surfaces, &flags.resections.sheets})
        for (const std::string& file : *files) io::note_input(file);
    RAMUS_TRY(read, load_case(flags));
    RAMUS_TRY(plan, plan_of(read, flags));
    const auto whole = static_cast<double>(read.organ.count());
    if (plan.removal.removed_voxels == 0.0 || plan.removal.removed_voxels >= whole)
        std::cerr << "ramus: " << (plan.removal.removed_voxels == 0.0 ? "nothing" : "all")
                  << " of the organ is removed\n";
    if (auto written = write_resection(read, plan, flags.output); !written) return tl::unexpected(written.error());
    if (flags.json)
        std::cout << printed_report(resection_report(read, plan, flags), read.claims) << '\n';
    else
        print_resection(read, plan);
    return kDone;
}

} // namespace

void register_resect(CLI::App& app, Action& chosen) {
    CLI::App* command =
        add_command(app, "resect", "What a resection removes of an organ, what it cuts, and what stays");
    command->footer("A margin is the least distance between the boxes of a lesion's voxels and the resection's surface "
                    "within the organ. What stays is supplied where no vessel in front of it is cut; territories are "
                    "estimated by distance, as in `ramus territories`.");
    const auto flags = std::make_shared<ResectFlags>();
    add_input(*command, "--tree", "TREE", flags->tree, "Vessel tree, or a mask of vessels")->required();
    add_resection_options(*command, flags->resections);
    add_organ_options(*command, *flags);
    add_option(*command, "-o,--output", "FILE", flags->output,
               "Label map of the remnant (1) and the removed part (2): " + io::label_map_extensions() +
                   "; or the resection's surface as a mesh: " + io::writable_mesh_extensions());
    flags->reading.command = command;
    add_source_flags(*command, flags->reading);
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    command->callback([command, flags, &chosen] {
        check_resection_flags(*command, flags->resections);
        if (flags->lesions.empty()) flags->lesions = flags->resections.wedge;
        chosen = [flags] { return run_resect(*flags); };
    });
}

} // namespace ramus::app
