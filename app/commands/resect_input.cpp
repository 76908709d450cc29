#include "app/commands/resect_input.h"

#include "app/assets/half_turn.h"
#include "app/commands/command.h"
#include "app/commands/inputs.h"
#include "app/commands/progress.h"
#include "app/commands/sheet_file.h"
#include "app/commands/surface_input.h"
#include "app/session/error_context.h"
#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/text_numbers.h"
#include "core/organ/resect/cut_vessels.h"
#include "core/organ/resect/dividing_surface.h"
#include "core/organ/resect/removal.h"
#include "core/organ/resect/sheet.h"
#include "core/volume/label_counts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::app {

namespace {

// "X,Y,Z,NX,NY,NZ".
std::optional<organ::HalfSpace> plane_in(std::string_view text) {
    std::vector<std::string_view> words;
    io::split_words(text, ",", words);
    if (words.size() != 6) return {};
    std::array<double, 6> numbers{};
    for (std::size_t n = 0; n < 6; ++n) {
        const auto number = io::to_real(words[n]);
        if (!number || !(std::abs(*number) < 1e9)) return {};
        numbers[n] = *number;
    }
    const glm::dvec3 normal(numbers[3], numbers[4], numbers[5]);
    if (!(glm::length(normal) > 1e-9)) return {};
    return organ::HalfSpace{{numbers[0], numbers[1], numbers[2]}, glm::normalize(normal)};
}

Result<organ::Sheet> sheet_in(const std::string& file, const OrganCase& read, bool other_side) {
    RAMUS_TRY(from_file, read_sheet(file));
    organ::Sheet sheet = std::move(from_file.sheet);
    if (!from_file.from_contour) return sheet;
    const organ::Resection above = sheet;
    RAMUS_TRY(removal, with_progress(
                           "sheet",
                           [&](Job& job) {
                               return organ::remove_from(read.organ, std::span(&above, 1), JobRange(job, 0.0F, 1.0F));
                           },
                           kNothingWritten));
    const bool above_is_smaller = removal.removed_voxels <= 0.5 * static_cast<double>(read.organ.count());
    sheet.removes_below = above_is_smaller == other_side;
    return sheet;
}

Result<organ::SurfaceCut> surface_in(const std::string& file, const OrganCase& read, const ResectionFlags& flags) {
    RAMUS_TRY(input, load_mesh(file, flags.mesh_axes));
    if (input.mesh.triangles.empty()) return fail("there is no surface in it", file);
    warn_of_stated_axes(file, input, flags.mesh_axes);
    warn_of_half_turn(file, input, {render::bounds_of(read.tree), read.tree.claims.orientation},
                      other_axes_option(flags.mesh_axes));
    RAMUS_TRY(surface, with_progress(
                           "surface",
                           [&](Job& job) {
                               return with_file(organ::DividingSurface::of(std::move(input.mesh), read.organ,
                                                                           JobRange(job, 0.0F, 1.0F)),
                                                file);
                           },
                           kNothingWritten));
    return organ::SurfaceCut{std::move(surface), flags.other_side};
}

Result<organ::Around> territory_of(const OrganCase& read, const OrganFlags& organ_flags, const ResectionFlags& flags,
                                   const SystemSupplies& systems) {
    for (const measure::Cut& cut : flags.cuts)
        if (auto there = check_branch(read.tree, cut.first, organ_flags.tree); !there)
            return tl::unexpected(there.error());
    auto lost =
        organ::solid_of(read.organ, organ::lost_voxels(systems.parts, measure::lost_spans(read.tree, flags.cuts)));
    if (lost == nullptr)
        return fail("no voxel of the organ depends on the cuts", organ_flags.tree,
                    "cut a branch that leads into the organ");
    return organ::Around{std::move(lost), flags.margin_mm.value_or(0.0),
                         std::make_shared<const std::vector<std::uint8_t>>(organ::spared_by(read.tree, flags.cuts))};
}

// The labels of a mask whose lesions are wanted; empty: the mask has none.
Result<std::vector<std::int32_t>> labels_of(const volume::Volume& volume,
                                            const std::vector<volume::LabelChoice>& chosen) {
    if (!chosen.empty()) return volume::label_numbers(volume, chosen);
    std::vector<std::int32_t> labels;
    for (const volume::LabelCount& count : volume::label_counts(volume)) labels.push_back(count.label);
    return labels;
}

} // namespace

Result<std::vector<organ::VoxelLesion>> load_lesions(const std::string& file, const OrganFlags& flags) {
    RAMUS_TRY(volume, load_volume(file, mask_flags(flags)));
    RAMUS_TRY(labels, with_file(labels_of(volume, flags.lesion_labels), file));
    std::vector<std::vector<volume::LabelChoice>> groups;
    for (const std::int32_t label : labels) groups.push_back({volume::LabelChoice(label)});
    if (groups.empty()) groups.emplace_back();
    std::vector<organ::VoxelLesion> lesions;
    for (const std::vector<volume::LabelChoice>& group : groups) {
        RAMUS_TRY(mask, with_progress(
                            "lesions",
                            [&](Job& job) {
                                return with_file(organ::organ_of(volume, {group, {}}, JobRange(job, 0.0F, 1.0F)), file);
                            },
                            kNothingWritten));
        std::string name = "lesion";
        if (groups.size() > 1) name = "label " + std::to_string(group.front().number);
        if (!group.empty())
            if (const volume::LabelName* known = volume::name_of_label(volume, group.front().number);
                known != nullptr && !known->name.empty())
                name = known->name;
        for (organ::VoxelLesion& one : organ::lesions_of(mask, name)) lesions.push_back(std::move(one));
    }
    return lesions;
}

Result<std::vector<NamedResection>> resections_of(const OrganCase& read, const OrganFlags& organ_flags,
                                                  const ResectionFlags& flags, const SystemSupplies& systems) {
    std::vector<NamedResection> all;
    for (const organ::HalfSpace& plane : flags.planes) all.push_back({"plane", plane});
    for (const std::string& file : flags.sheets) {
        RAMUS_TRY(sheet, sheet_in(file, read, flags.other_side));
        all.push_back({"sheet", std::move(sheet)});
    }
    for (const std::string& file : flags.surfaces) {
        RAMUS_TRY(cut, surface_in(file, read, flags));
        all.push_back({"surface", std::move(cut)});
    }
    if (!flags.cuts.empty()) {
        RAMUS_TRY(lost, territory_of(read, organ_flags, flags, systems));
        all.push_back({"cuts", std::move(lost)});
    }
    if (!flags.wedge.empty()) {
        RAMUS_TRY(mask, load_organ(flags.wedge, organ_flags.lesion_labels, mask_flags(organ_flags)));
        all.push_back({"lesion", organ::Around{organ::solid_of(mask, {}), flags.margin_mm.value_or(0.0)}});
    }
    return all;
}

void add_resection_options(CLI::App& command, ResectionFlags& flags) {
    add_option_taking<std::vector<std::string>>(
        command, "--plane", "X,Y,Z,NX,NY,NZ",
        [&flags](const std::vector<std::string>& words) {
            for (const std::string& word : words) flags.planes.push_back(*plane_in(word));
        },
        "Plane through a point (mm); what the normal points to is removed. Several are allowed")
        ->check(expecting(" is not a point and a normal of six numbers", plane_in));
    add_input(command, "--surface", "MESH", flags.surfaces,
              "Surface that divides the organ (" + io::readable_mesh_extensions() +
                  "): of a closed one the inside is removed, of an open one the smaller part. Several are allowed");
    add_input(command, "--sheet", "FILE", flags.sheets,
              "Smooth sheet: a JSON file with its control grid, or a contour on the organ, as JSON or as text with a "
              "point a line. Several are allowed");
    add_option_taking<std::string>(
        command, "--cut", "ID@F,...", [&flags](const std::string& text) { flags.cuts = *cuts_in(text); },
        "Remove all that depends on cuts of branches (at fraction F of their length), with --margin around it")
        ->check(expecting(" is not a list of cuts, as 12@0.3,40@0.5", cuts_in));
    add_input(command, "--lesion", "MASK", flags.wedge, "Remove the lesions of a mask, with --margin around them");
    add_option(command, "--margin", "MM", flags.margin_mm, "Margin of --cut and --lesion (default 0)")
        ->check(CLI::Range(0.0, 1000.0));
    command.add_flag("--other-side", flags.other_side,
                     "Remove the other side of --surface, and of --sheet with a contour");
    add_mesh_orientation_flag(command, flags.mesh_axes, "--surface");
}

void check_resection_flags(const CLI::App& command, const ResectionFlags& flags) {
    const bool around = !flags.cuts.empty() || !flags.wedge.empty();
    const std::size_t count = flags.planes.size() + flags.surfaces.size() + flags.sheets.size() + (around ? 2 : 0);
    if (count == 0)
        throw CLI::ValidationError(command.get_name(),
                                   "give what is removed: --plane, --surface, --sheet, --cut or --lesion");
    if (count > organ::kMostResections)
        throw CLI::ValidationError(command.get_name(),
                                   "more than " + std::to_string(organ::kMostResections) + " resections in one plan");
    if (flags.margin_mm && !around) throw CLI::ValidationError("--margin", "needs --cut or --lesion");
    if (flags.other_side && flags.surfaces.empty() && flags.sheets.empty())
        throw CLI::ValidationError("--other-side", "needs --surface or --sheet");
    if (!flags.mesh_axes.empty() && flags.surfaces.empty())
        throw CLI::ValidationError("--mesh-orientation", "needs --surface");
}

} // namespace ramus::app
