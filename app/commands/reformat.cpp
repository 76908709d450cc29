// `ramus reformat TREE`: cross-sections of a vessel, and pictures of a scan along it.
#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/picture_flags.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/reformat_picture.h"
#include "app/commands/reformat_report.h"
#include "app/commands/reformat_sections.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/commands/surface_input.h"
#include "app/reports/section_tables.h"
#include "app/session/along_vessel.h"
#include "app/session/error_context.h"
#include "core/base/words.h"
#include "core/io/output_file.h"
#include "core/io/run_inputs.h"
#include "core/io/standard_input.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

namespace {

constexpr const char* kSections = "sections";

struct ReformatFlags {
    SurfaceFlags surface;
    std::string tree, scan, output, format;
    std::string mask;
    MaskInput mask_input;
    Way way;
    std::optional<slice::ReformationKind> kind = slice::ReformationKind::kStraightened; // none: sections
    double angle_deg = 0.0;
    std::optional<double> width_mm, step_mm;
    std::optional<slice::Window> window;
    std::optional<Reference> reference;
    std::optional<Way> between;
    bool json = false;

    [[nodiscard]] std::string extension() const { return std::filesystem::path(output).extension().string(); }
    [[nodiscard]] bool is_picture() const { return extension() == ".png"; }
};

bool is_kind(const std::string& word) { return word == kSections || slice::reformation_named(word); }

Result<MaskVoxels> mask_voxels(const ReformatFlags& flags) {
    RAMUS_TRY(volume, load_volume(flags.mask, with_units(flags.surface, flags.mask_input)));
    warn_about(flags.mask, volume);
    RAMUS_TRY(inside, with_progress("mask", [&](Job& job) {
                  return with_file(
                      volume::inside(volume, {flags.mask_input.labels, std::nullopt}, JobRange(job, 0.0F, 1.0F)),
                      flags.mask);
              }));
    return MaskVoxels{std::move(inside), volume.to_patient};
}

Result<void> check_in_scan(const slice::VesselPath& path, const volume::Volume& scan, const std::string& file) {
    const auto bounds = slice::bounds_of(scan);
    const auto is_inside = [&](const slice::PathSample& sample) {
        return glm::all(glm::greaterThanEqual(sample.at, bounds.least)) &&
               glm::all(glm::lessThanEqual(sample.at, bounds.most));
    };
    if (std::ranges::any_of(path.samples, is_inside)) return {};
    return fail("the path lies outside of the scan", io::input_name(file),
                "check that both are of one patient, and the --orientation and --units of the tree");
}

// The inputs, and what is derived of them for all outputs.
struct ReformatCase {
    tree::VesselTree tree;
    std::optional<volume::Volume> scan;
    std::optional<MaskVoxels> mask;
    mesh::TriangleMesh mesh;
};

double step_of(const ReformatFlags& flags, const ReformatCase& read) {
    const double fine = read.scan ? fine_step_mm(*read.scan) : 0.0;
    return flags.kind ? flags.step_mm.value_or(fine) : path_step_mm(fine, flags.step_mm);
}

std::vector<slice::PathSample> samples_for(const ReformatFlags& flags, const slice::VesselPath& path) {
    if (flags.kind) return path.samples;
    return flags.step_mm ? samples_every(path, *flags.step_mm) : usual_samples(path);
}

Result<ReformatCase> read_case(const ReformatFlags& flags) {
    ReformatCase read;
    for (const std::string* file : {&flags.tree, &flags.scan, &flags.mask})
        if (!file->empty()) io::note_input(*file);
    RAMUS_TRY(tree, load_tree(flags.tree, flags.surface));
    read.tree = std::move(tree);
    const SurfaceFlags volumes = with_units(flags.surface, flags.mask_input);
    if (!flags.scan.empty()) {
        RAMUS_TRY(scan, load_volume(flags.scan, volumes));
        warn_about(flags.scan, scan);
        read.scan = std::move(scan);
    }
    if (!flags.mask.empty()) {
        RAMUS_TRY(mask, mask_voxels(flags));
        read.mask = std::move(mask);
    }
    return read;
}

// What is narrower than the reference, by sections at the samples of the path.
Result<std::optional<NarrowPlaces>> narrow_places(const ReformatFlags& flags, const ReformatCase& read,
                                                  const slice::VesselPath& path, const Lumens& lumens) {
    if (!flags.reference) return std::optional<NarrowPlaces>();
    const std::vector<slice::SectionFigures> figures = section_figures(lumens);
    NarrowPlaces places;
    if (flags.reference->diameter_mm) {
        places.reference = slice::figures_of_disc(*flags.reference->diameter_mm);
    } else {
        RAMUS_TRY(range, with_file(samples_of(path, flags.reference->way), "--path"));
        RAMUS_TRY(reference, slice::reference_of(figures, range));
        places.reference = reference;
    }
    slice::SampleRange range = inner_samples(read.tree, path);
    if (flags.between) {
        RAMUS_TRY(chosen, with_file(samples_of(path, *flags.between), "--path"));
        range = chosen;
    }
    RAMUS_TRY(found, slice::stenosis_of(figures, range, places.reference));
    places.found = found;
    return std::optional(places);
}

class Reformatter {
public:
    Reformatter(const ReformatFlags& flags, const ReformatCase& read, slice::VesselPath path)
        : flags_(flags), read_(read), blocks_(read.mesh), others_(read.tree, path), lengths_(read.tree.claims) {
        for (const slice::PathSample& sample : path.samples) widest_mm_ = std::max(widest_mm_, sample.radius_mm);
        figures_.path = std::move(path);
    }

    Result<ReformatFigures> measured() {
        const slice::VesselPath& path = figures_.path;
        figures_.samples = samples_for(flags_, path);
        figures_.sections = outlines_at(figures_.samples);
        const bool is_all = flags_.kind.has_value() || !flags_.reference;
        const Outlines all = is_all ? Outlines{} : outlines_at(path.samples);
        RAMUS_TRY(by_surface, narrow_places(flags_, read_, path, is_all ? figures_.sections.surface : all.surface));
        figures_.by_surface = by_surface;
        if (read_.mask) {
            RAMUS_TRY(by_mask, narrow_places(flags_, read_, path, is_all ? figures_.sections.mask : all.mask));
            figures_.by_mask = by_mask;
        }
        return std::move(figures_);
    }

    [[nodiscard]] Result<PaintedSlices> painted(const ReformatFigures& figures) const {
        const double diameters = flags_.kind ? 4.0 : 2.5; // of the widest place
        const double width = flags_.width_mm.value_or(diameters * 2.0 * widest_mm_);
        if (!flags_.kind)
            return painted_sections(*read_.scan, figures.samples, width, figures.sections, flags_.window, lengths_);
        const auto picture = slice::reformation_along(figures.path, *flags_.kind, flags_.angle_deg, width);
        if (*flags_.kind == slice::ReformationKind::kStraightened)
            return painted_reformation(*read_.scan, figures.path, picture, figures.sections, flags_.window, lengths_);
        Outlines rows{slice::lumens_of_rows(picture, loops_of(blocks_)), {}};
        if (read_.mask) rows.mask = slice::lumens_of_rows(picture, loops_of(*read_.mask, 1.5 * widest_mm_));
        return painted_reformation(*read_.scan, figures.path, picture, rows, flags_.window, lengths_);
    }

private:
    [[nodiscard]] Outlines outlines_at(const std::vector<slice::PathSample>& samples) const {
        Outlines outlines{slice::lumens_along(samples, loops_of(blocks_), others_), {}};
        if (read_.mask) outlines.mask = slice::lumens_along(samples, loops_of(*read_.mask, 1.5 * widest_mm_), others_);
        return outlines;
    }

    const ReformatFlags& flags_;
    const ReformatCase& read_;
    slice::MeshBlocks blocks_;
    slice::OtherBranches others_;
    Lengths lengths_;
    double widest_mm_ = 0.0;
    ReformatFigures figures_;
};

Result<void> check_output_of(const ReformatFlags& flags) {
    if (flags.output.empty()) return {};
    if (!flags.is_picture() && flags.extension() != ".csv")
        return fail("the output is neither a picture nor a table", flags.output, "use .png or .csv");
    return io::check_output(flags.output);
}

Result<void> write_table(const Table& table, const std::string& output) {
    RAMUS_TRY(file, io::OutputFile::create(output));
    file.write(csv_of(table));
    return file.commit();
}

Result<int> run_reformat(const ReformatFlags& flags) {
    if (auto possible = check_output_of(flags); !possible) return tl::unexpected(possible.error());
    RAMUS_TRY(read, read_case(flags));
    RAMUS_TRY(path, with_file(path_along(read.tree, flags.way, step_of(flags, read)), flags.tree));
    if (read.scan)
        if (auto inside = check_in_scan(path, *read.scan, flags.scan); !inside) return tl::unexpected(inside.error());
    RAMUS_TRY(surface, with_file(surface_of_tree(read.tree, flags.surface), flags.tree));
    read.mesh = std::move(surface.mesh);
    const Lengths lengths(read.tree.claims);
    Reformatter reformatter(flags, read, std::move(path));
    RAMUS_TRY(figures, reformatter.measured());
    if (flags.is_picture()) {
        RAMUS_TRY(picture, reformatter.painted(figures));
        if (auto written = render::write_png(picture.image, flags.output); !written)
            return tl::unexpected(written.error());
        figures.picture = std::move(picture);
    } else if (!flags.output.empty()) {
        if (auto written = write_table(sections_table(figures.samples, figures.sections, lengths), flags.output);
            !written)
            return tl::unexpected(written.error());
    }
    if (flags.json)
        std::cout << printed_report(reformat_json(figures, read.tree.claims), read.tree.claims) << '\n';
    else
        std::cout << reformat_text(figures, lengths);
    return kDone;
}

auto positive() {
    return expecting(" is not a positive number", [](const std::string& word) {
        const auto value = parsed<double>(word);
        return value && *value > 0.0 && std::isfinite(*value);
    });
}

void add_way_options(CLI::App& command, const std::shared_ptr<ReformatFlags>& flags) {
    add_option_taking<std::string>(
        command, "--path", "ID|A..B", [flags](const std::string& text) { flags->way = *way_in(text); },
        "The vessel: a branch, or the shortest way from A to B; each is ID or ID@FRACTION of the branch's length, and "
        "A "
        "may be root. Without a fraction, A is the start of its branch and B the end")
        ->required()
        ->check(expecting(" is not ID or A..B, as 12, root..12 or 3@0.2..12@0.5", way_in));
    add_option_taking<std::string>(
        command, "--reference", "MM|PLACE|A..B",
        [flags](const std::string& text) { flags->reference = *reference_in(text); },
        "What the narrowest section is compared with: a diameter, a place as 12@0.3, or the mean of a stretch")
        ->check(expecting(" is not a diameter, a place as 12@0.3 or a stretch as 12@0.1..12@0.4", reference_in));
    add_option_taking<std::string>(
        command, "--between", "A..B", [flags](const std::string& text) { flags->between = *way_in(text); },
        "Where the narrowest section is searched (default: the whole path, without one radius before free ends)")
        ->check(expecting(" is not A..B, as 3@0.2..12@0.5",
                          [](const std::string& text) {
                              const auto way = way_in(text);
                              return way && way->to && way->from.branch >= 0;
                          }))
        ->needs("--reference");
}

void add_view_options(CLI::App& command, const std::shared_ptr<ReformatFlags>& flags) {
    add_option_taking<std::string>(
        command, "--kind", "straightened|stretched|sections",
        [flags](const std::string& word) { flags->kind = slice::reformation_named(word); },
        "The picture: the vessel straightened (default) or stretched, or a sheet of cross-sections")
        ->check(expecting(" is not straightened, stretched or sections", is_kind));
    add_option(command, "--angle", "DEG", flags->angle_deg, "Turn the picture about the vessel's axis");
    add_option(command, "--across", "MM", flags->width_mm,
               "Width across the vessel (default: 4 of its largest diameters, 2.5 in sections)")
        ->check(positive());
    add_option(command, "--step", "MM", flags->step_mm,
               "From row to row along the vessel (default: half a voxel of the scan), and the size of a pixel; of "
               "sections, from one to the next (default: 24 sections)")
        ->check(positive());
    add_window_flag(command, flags->window);
}

} // namespace

void register_reformat(CLI::App& app, Action& chosen) {
    CLI::App* command =
        add_command(app, "reformat", "Show a scan along a vessel, and measure the vessel's cross-sections");
    command->footer(
        "Sections are at right angles to the centerline, smoothed over one radius. Lines on pictures are the "
        "surface of the tree in the colours of its branches, and the mask in white. Figures are of the "
        "surface, and of the mask if one is given.");
    const auto flags = std::make_shared<ReformatFlags>();
    add_input(*command, "TREE", "", flags->tree, "Vessel tree, or a mask of vessels")->required();
    add_way_options(*command, flags);
    add_input(*command, "--scan", "VOLUME", flags->scan, "Scan: " + io::readable_volume_extensions());
    add_input(*command, "--mask", "MASK", flags->mask,
              "Mask of the vessels, for its sections: " + io::readable_volume_extensions());
    add_label_flag(*command, flags->mask_input.labels, "Labels of the mask (default: all)")->needs("--mask");
    add_mask_units_flag(*command, flags->mask_input.units, "--scan and --mask");
    add_view_options(*command, flags);
    add_option(*command, "-o,--output", "FILE", flags->output,
               "Picture (.png) or table of cross-sections (.csv) to write; - is standard output");
    add_format_flag(*command, flags->format, {".png", ".csv"});
    command->add_flag("--json", flags->json, "Print the figures as one JSON object");
    flags->surface.command = command;
    add_surface_flags(*command, flags->surface);
    command->callback([command, flags, &chosen] {
        check_output_flags(*command, flags->output, flags->format);
        const bool is_picture = flags->is_picture() || flags->format == "png" || flags->format == ".png";
        if (is_picture && flags->scan.empty()) throw CLI::ValidationError("--scan", "a picture needs a scan");
        chosen = [flags] { return with_output(*flags, run_reformat); };
    });
}

} // namespace ramus::app
