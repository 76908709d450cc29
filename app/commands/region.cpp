// `ramus region VOLUME --seed X,Y,Z`: grows a region of similar values in a scan, and writes it as a mask.
#include "app/assets/region.h"

#include "app/actions/arguments.h"
#include "app/assets/scans.h"
#include "app/commands/command.h"
#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/session/error_context.h"
#include "app/session/numbers.h"
#include "core/io/run_inputs.h"
#include "core/io/standard_input.h"
#include "core/io/volumes/label_map_file.h"
#include "core/io/volumes/volume_unit.h"

#include <array>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

struct RegionFlags {
    SurfaceFlags reading;
    std::string scan, output, format;
    std::vector<glm::dvec3> seeds; // mm, RAS
    std::optional<std::array<double, 2>> range;
    std::vector<RegionCut> cuts;
    bool grey = false, json = false;
};

Result<volume::Volume> read_scan_of(const RegionFlags& flags) {
    io::note_input(flags.scan);
    RAMUS_TRY(scan, load_volume(flags.scan, flags.reading));
    warn_about(flags.scan, scan);
    if (!flags.grey && holds_labels(scan, segmentation_labels(scan)))
        return fail("it holds labels, and a region grows by the values of a scan", io::input_name(flags.scan),
                    "give the scan; if this is one of few values, say so: --grey");
    return std::move(scan);
}

Result<RegionOf> region_of(const RegionFlags& flags, const volume::Volume& scan) {
    RegionOf region;
    region.cuts = flags.cuts;
    if (flags.range) {
        region.low = flags.range->front();
        region.high = flags.range->back();
        region.suggested = false;
    }
    for (const glm::dvec3& seed : flags.seeds) {
        RAMUS_TRY(voxel, voxel_at(scan, seed));
        RAMUS_TRY(next, with_seed(std::move(region), scan, voxel));
        region = std::move(next);
    }
    return region;
}

nlohmann::ordered_json voxels_json(const std::vector<glm::ivec3>& voxels) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const glm::ivec3& voxel : voxels) all.push_back({voxel.x, voxel.y, voxel.z});
    return all;
}

const char* range_origin(const RegionOf& of) { return of.suggested ? "suggested by the seeds" : "given"; }

nlohmann::ordered_json region_json(const RegionOf& of, const volume::GrownRegion& region, const volume::Volume& scan,
                                   const tree::Claims& claims) {
    nlohmann::ordered_json report{
        {"note", kRegionIsNoSegmentation},
        {"range", {{"low", of.low}, {"high", of.high}, {"origin", of.suggested ? "suggested" : "given"}}},
        {"seeds", voxels_json(of.seeds)},
        {"seeds_not_used", voxels_json(region.unused)},
        {"voxels", region.count},
        {"volume_mm3", static_cast<double>(region.count) * volume::voxel_volume_mm3(scan.to_patient)},
        {"first_voxel", {region.bounds.first.x, region.bounds.first.y, region.bounds.first.z}},
        {"last_voxel", {region.bounds.last.x, region.bounds.last.y, region.bounds.last.z}},
        {"touches_border", region.touches_border},
        {"unit", claims.unit_word()},
        {"orientation", claims.axes_word()}};
    if (!scan.value_unit.empty()) report["value_unit"] = scan.value_unit;
    return report;
}

void print_region(const RegionOf& of, const volume::GrownRegion& region, const volume::Volume& scan,
                  const tree::Claims& claims) {
    const double mm3 = static_cast<double>(region.count) * volume::voxel_volume_mm3(scan.to_patient);
    std::cout << "region        " << counted(region.count, "voxel", "voxels") << ", " << Lengths(claims).volume(mm3)
              << '\n'
              << "values        " << exact_text(of.low) << " to " << exact_text(of.high)
              << (scan.value_unit.empty() ? "" : " " + scan.value_unit) << ", " << range_origin(of) << '\n'
              << "border        " << (region.touches_border ? "touches" : "does not touch")
              << " the border of the scan\n";
    if (!region.unused.empty())
        std::cerr << "ramus: " << counted(region.unused.size(), "seed is", "seeds are")
                  << " not used: out of the range, or in a ball\n";
    std::cout << "note          " << kRegionIsNoSegmentation << '\n';
}

Result<int> run_region(const RegionFlags& flags) {
    if (!flags.output.empty())
        if (auto possible = io::check_label_map_output(flags.output); !possible)
            return tl::unexpected(possible.error());
    RAMUS_TRY(scan, read_scan_of(flags));
    RAMUS_TRY(of, with_file(region_of(flags, scan), flags.scan));
    RAMUS_TRY(region, with_progress(
                          "region",
                          [&](Job& job) {
                              constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
                              return with_file(grown_region(of, scan, kMost, JobRange(job, 0.0F, 1.0F)), flags.scan);
                          },
                          kNothingWritten));
    const tree::Claims claims = io::claims_of(scan, flags.reading.read.unit);
    if (!flags.output.empty()) {
        const auto write = [&](Job& job) {
            return write_region(region, scan, claims, flags.output, JobRange(job, 0.0F, 1.0F));
        };
        if (auto written = write_with_progress("mask", write); !written) return tl::unexpected(written.error());
    }
    if (flags.json)
        std::cout << printed_report(region_json(of, region, scan, claims), claims) << '\n';
    else
        print_region(of, region, scan, claims);
    return kDone;
}

std::optional<RegionCut> ball_in(const std::string& text) {
    const auto numbers = actions::numbers_in(text, 4, actions::kFarthestMm);
    if (!numbers || !(numbers->back() > 0.0)) return {};
    return RegionCut{{numbers->at(0), numbers->at(1), numbers->at(2)}, {}, numbers->back()};
}

std::optional<RegionCut> disc_in(const std::string& text) {
    const auto numbers = actions::numbers_in(text, 7, actions::kFarthestMm);
    if (!numbers || !(numbers->back() > 0.0)) return {};
    const glm::dvec3 normal(numbers->at(3), numbers->at(4), numbers->at(5));
    if (normal == glm::dvec3(0.0)) return {};
    return RegionCut{{numbers->at(0), numbers->at(1), numbers->at(2)}, normal, numbers->back()};
}

// An option that may be given several times. `in` parses a word; `what`: "a place as 12,-40,310".
template <class Take, class In>
CLI::Option* add_repeated(CLI::App& command, const char* name, const char* type, const In& in, const Take& take,
                          const std::string& what, const std::string& help) {
    return add_option_taking<std::vector<std::string>>(
               command, name, type,
               [in, take](const std::vector<std::string>& words) {
                   for (const std::string& word : words) take(*in(word));
               },
               help + "; may be given several times")
        ->allow_extra_args(false)
        ->check(expecting(" is not " + what, [in](const std::string& word) { return in(word).has_value(); }));
}

void add_region_options(CLI::App& command, const std::shared_ptr<RegionFlags>& flags) {
    add_repeated(
        command, "--seed", "X,Y,Z",
        [](const std::string& word) { return actions::numbers_in(word, 3, actions::kFarthestMm); },
        [flags](const std::vector<double>& at) { flags->seeds.emplace_back(at[0], at[1], at[2]); },
        "a place in mm, as 12,-40,310", "A place in the vessel, mm RAS")
        ->required();
    const auto range_in = [](const std::string& word) {
        constexpr double kMost = 1e12;
        auto range = actions::numbers_in(word, 2, kMost);
        return range && range->front() <= range->back() ? range : std::nullopt;
    };
    add_option_taking<std::string>(
        command, "--range", "LOW,HIGH",
        [flags, range_in](const std::string& word) {
            const auto range = range_in(word);
            flags->range = {range->front(), range->back()};
        },
        "Values of the region (default: mean -+ 2.5 standard deviations around the seeds)")
        ->check(expecting(" is not two values, the lower one first, as 150,400",
                          [range_in](const std::string& word) { return range_in(word).has_value(); }));
    const auto take = [flags](const RegionCut& cut) { flags->cuts.push_back(cut); };
    add_repeated(command, "--ball", "X,Y,Z,R", ball_in, take, "a place and a radius of more than 0, in mm",
                 "Leave out the voxels in this ball, mm RAS");
    add_repeated(command, "--disc", "X,Y,Z,NX,NY,NZ,R", disc_in, take,
                 "a place, a direction and a radius of more than 0, in mm",
                 "Do not grow through the disc with this radius across the direction N, mm RAS");
}

} // namespace

void register_region(CLI::App& app, Action& chosen) {
    CLI::App* command =
        add_command(app, "region", "Grow a region of similar values in a scan from a place in a vessel, as a mask");
    command->footer("A region of values is no segmentation. It leaks where neighbouring tissue has similar values, and "
                    "ends where noise exceeds the range: compare it with the scan on every slice. `ramus skeletonize` "
                    "makes a vessel tree of the mask.");
    const auto flags = std::make_shared<RegionFlags>();
    add_input(*command, "VOLUME", "", flags->scan, "Scan: a volume, or a folder of DICOM files")->required();
    add_region_options(*command, flags);
    command->add_flag("--grey", flags->grey, "The volume is a scan, although it has as few values as a segmentation");
    add_option(*command, "-o,--output", "FILE", flags->output,
               "Mask to write, on the grid of the scan: " + io::label_map_extensions());
    add_format_flag(*command, flags->format, {".nii.gz", ".nii", ".seg.nrrd", ".nrrd"});
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    add_units_flag(*command, flags->reading.read);
    add_memory_option(*command, "--memory", flags->reading.surface.memory_bytes,
                      "Most memory to use, as 800M or 4G (default 0: half of the machine's)");
    flags->reading.command = command;
    command->callback([command, flags, &chosen] {
        check_output_flags(*command, flags->output, flags->format);
        chosen = [flags] { return with_output(*flags, run_region); };
    });
}

} // namespace ramus::app
