// `ramus slice VOLUME -o PNG`: one slice of a scan, with vessels and a segmentation drawn on it; or its values.
#include "app/assets/assets.h"
#include "app/commands/command.h"
#include "app/commands/inputs.h"
#include "app/commands/output_target.h"
#include "app/commands/picture_flags.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/picture/compose.h"
#include "app/picture/figure_options.h"
#include "app/picture/slices.h"
#include "app/workspace/surface_maker.h"
#include "core/base/words.h"
#include "core/io/output_file.h"
#include "core/io/run_inputs.h"
#include "core/io/volumes/value_map_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/mesh/surface.h"
#include "core/slice/sample.h"
#include "render/image/image.h"
#include "render/renderer/drawn.h"
#include "render/slice/slice_painter.h"

#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

struct SliceFlags {
    SurfaceFlags common;
    std::string file, output, tree, mask, mask_units, scan_units, session;
    slice::Direction plane = slice::Direction::kAxial;
    std::optional<std::array<double, 3>> at, normal;
    std::optional<slice::Window> window; // none: the usual one of the scan
    slice::Sampling sampling;
    std::optional<glm::ivec2> size; // none: all voxels, at their spacing
    bool nearest = false, plain = false, json = false;
};

Scan scan_of(const std::string& file, const std::string& units, bool labels) {
    Scan scan;
    scan.file = std::filesystem::absolute(file).lexically_normal().string();
    scan.units = units;
    scan.labels = labels;
    return scan;
}

// The session that the command line describes. The tree is not read yet.
Result<OpenedSession> open_slice(const SliceFlags& flags) {
    OpenedSession opened;
    if (!flags.tree.empty()) {
        RAMUS_TRY(read, open_session(flags.tree, {}, flags.common));
        opened = std::move(read);
    }
    Marks& marks = opened.session.marks;
    marks.options.memory_bytes = flags.common.surface.memory_bytes;
    marks.scans.push_back(scan_of(flags.file, flags.scan_units, false));
    marks.scans.back().part = flags.common.read.part;
    marks.scans.back().window = flags.window;
    if (!flags.mask.empty()) marks.scans.push_back(scan_of(flags.mask, flags.mask_units, true));
    number_objects(marks);
    SliceViews& views = opened.session.slices;
    views.sampling = flags.sampling;
    if (flags.nearest) views.sampling.interpolation = slice::Interpolation::kNearest;
    views.crosshair_lines = false;
    if (flags.at) views.crosshair = glm::dvec3((*flags.at)[0], (*flags.at)[1], (*flags.at)[2]);
    if (flags.normal)
        views.oblique_normal = glm::normalize(glm::dvec3((*flags.normal)[0], (*flags.normal)[1], (*flags.normal)[2]));
    return opened;
}

nlohmann::ordered_json vector_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// The loops of the vessels' surface, with the branch of each point.
nlohmann::ordered_json outlines_json(const std::vector<render::VesselLoop>& vessels) {
    nlohmann::ordered_json outlines = nlohmann::ordered_json::array();
    for (const render::VesselLoop& loop : vessels) {
        nlohmann::ordered_json points = nlohmann::ordered_json::array();
        for (const glm::dvec3& point : loop.points) points.push_back(vector_json(point));
        outlines.push_back({{"closed", loop.closed}, {"points", std::move(points)}, {"branches", loop.branches}});
    }
    return outlines;
}

nlohmann::ordered_json slice_report(const SliceFlags& flags, const Session& session, const Assets& assets,
                                    const render::SliceView& view, const render::FrameSection& section) {
    const tree::Claims claims = slice_claims(session, assets);
    const glm::dvec3 at = crosshair_of(session, assets);
    const volume::Volume& volume = *view.scans.front().scan;
    const slice::PixelGrid& grid = view.grid;
    const float value = slice::value_at(volume, at);
    const slice::Window& window = view.scans.front().window;
    nlohmann::ordered_json report{{"plane", slice::name_of(flags.plane)},
                                  {"at", vector_json(at)},
                                  {"normal", vector_json(grid.plane().normal)},
                                  {"size", {grid.size.x, grid.size.y}},
                                  {"corner", vector_json(grid.corner)},
                                  {"right", vector_json(glm::normalize(grid.right))},
                                  {"down", vector_json(glm::normalize(grid.down))},
                                  {"pixel_mm", {glm::length(grid.right), glm::length(grid.down)}},
                                  {"unit", claims.unit_word()},
                                  {"orientation", claims.axes_word()},
                                  {"value", nullptr},
                                  {"window", {{"width", window.width}, {"level", window.level}}},
                                  {"outlines", outlines_json(section.vessels)},
                                  {"axes", nlohmann::ordered_json::array()}};
    if (!std::isnan(value)) report["value"] = value;
    if (!volume.value_unit.empty()) report["value_unit"] = volume.value_unit;
    for (const render::AxisCrossing& crossing : section.crossings)
        report["axes"].push_back({{"branch", crossing.branch}, {"at", vector_json(crossing.at)}});
    return report;
}

Result<void> check_inside(const Session& session, const Assets& assets, const std::string& file) {
    const auto scan = assets.scan(session.marks.scans.front());
    const Bounds<glm::dvec3> bounds = slice::bounds_of(*scan->volume);
    const glm::dvec3 at = crosshair_of(session, assets);
    for (int axis = 0; axis < 3; ++axis)
        if (at[axis] < bounds.least[axis] || at[axis] > bounds.most[axis])
            return fail("the place is outside of the scan, which reaches from " + rounded(bounds.least.x) + "," +
                            rounded(bounds.least.y) + "," + rounded(bounds.least.z) + " to " + rounded(bounds.most.x) +
                            "," + rounded(bounds.most.y) + "," + rounded(bounds.most.z),
                        file, "give --at a place inside");
    return {};
}

// The surface that `ramus mesh` writes: its outlines are exact also where vessels press on each other. Null: no tree.
Result<std::shared_ptr<const render::PagedMesh>> surface_of(const Document& document, const SliceFlags& flags) {
    if (!document.tree()) return nullptr;
    mesh::SurfaceOptions options = document.marks().options;
    options.threads = flags.common.surface.threads;
    const auto make = [&](Job& job) { return mesh::make_untangled_surface(*document.tree(), options, job); };
    RAMUS_TRY(surface, with_progress("surface", make, kNothingWritten));
    return paged(surface.mesh, *document.tree());
}

// The values of the slice as a volume of one slice that lies where the slice is; NaN outside of the scan.
Result<void> write_values(const SliceFlags& flags, const render::SliceView& view, const tree::Claims& claims) {
    const volume::Volume& scan = *view.scans.front().scan;
    const std::vector<float> values = slice::sampled(scan, view.grid, view.sampling);
    const slice::PixelGrid& grid = view.grid;
    const double thickness = view.sampling.slab_mm > 0.0 ? view.sampling.slab_mm : glm::length(grid.right);
    io::ValueMap map;
    map.size = {grid.size.x, grid.size.y, 1};
    map.to_patient = {glm::dvec4(grid.right, 0.0), glm::dvec4(grid.down, 0.0),
                      glm::dvec4(thickness * grid.plane().normal, 0.0), glm::dvec4(grid.corner, 1.0)};
    map.claims = claims;
    map.fill_slice =
        io::FillSlice<float>([&](int /*k*/, std::span<float> into) { std::ranges::copy(values, into.begin()); });
    map.value_unit = scan.value_unit;
    const auto write = [&](Job& job) { return io::write_value_map(map, flags.output, JobRange(job, 0.0F, 1.0F)); };
    return write_with_progress("slice", write);
}

Result<void> check_slice_output(const std::string& output) {
    if (output.empty()) return {};
    if (io::names_value_map(output)) return io::check_value_map_output(output);
    if (auto can = io::check_output(output); !can) return can;
    return render::check_png_name(output);
}

Result<int> run_slice(const SliceFlags& flags) {
    for (const std::string& file : {flags.file, flags.tree, flags.mask}) io::note_input(file);
    if (auto can = check_slice_output(flags.output); !can) return tl::unexpected(can.error());
    RAMUS_TRY(opened, open_slice(flags));
    Document document;
    document.open(std::move(opened.tree), std::move(opened.session), nullptr, {}, std::move(opened.base));
    Assets assets;
    const auto read = [&](Job& job) { return load_scans(assets, document.marks(), job); };
    if (auto scans = with_progress("scan", read, kNothingWritten); !scans) return tl::unexpected(scans.error());
    refresh(assets, document);
    const Session& session = document.session();
    if (auto inside = check_inside(session, assets, flags.file); !inside) return tl::unexpected(inside.error());
    RAMUS_TRY(surface, surface_of(document, flags));
    Viewing viewing;
    viewing.size = flags.size.value_or(glm::ivec2(1));
    const render::Frame frame = compose(session, assets, std::move(surface), viewing);
    render::SliceView view = compose_slice(session, assets, flags.plane, viewing);
    const volume::Volume& volume = *view.scans.front().scan;
    if (!flags.size)
        view.grid = slice::grid_covering(volume, axes_of(session.slices, flags.plane), crosshair_of(session, assets),
                                         slice::smallest_spacing_mm(volume));
    if (auto fits = render::check_size(view.grid.size.x, view.grid.size.y); !fits) {
        fits.error().hint = "give a --size";
        return tl::unexpected(fits.error());
    }
    if (flags.plain) {
        view.overlays.orientation_letters = view.overlays.scale_bar = false;
        view.overlays.caption.clear();
    }
    render::SlicePainter painter;
    const render::Image image = painter.paint(frame, view);
    if (io::names_value_map(flags.output)) {
        if (auto written = write_values(flags, view, slice_claims(session, assets)); !written)
            return tl::unexpected(written.error());
    } else if (!flags.output.empty()) {
        if (auto written = render::write_png(image, flags.output); !written) return tl::unexpected(written.error());
    }
    if (flags.json) std::cout << printed_report(slice_report(flags, session, assets, view, painter.section())) << '\n';
    return kDone;
}

void add_vector_option(CLI::App& command, const char* name, std::optional<std::array<double, 3>>& value,
                       const char* help) {
    add_option_taking<std::array<double, 3>>(
        command, name, "X,Y,Z", [&value](const std::array<double, 3>& numbers) { value = numbers; }, help)
        ->delimiter(',');
}

void add_slab_option(CLI::App& command, slice::Sampling& sampling) {
    add_option_taking<std::string>(
        command, "--slab", "MM[,maximum|mean|minimum]",
        [&sampling](const std::string& word) {
            const auto comma = word.find(',');
            const auto mm = parsed<double>(word.substr(0, comma));
            const auto of = comma == std::string::npos ? std::optional(slice::Slab::kMaximum)
                                                       : slice::slab_named(word.substr(comma + 1));
            if (!mm || !(*mm > 0.0 && *mm <= kMostSlabMm) || !of)
                throw CLI::ValidationError("--slab", word + " is not a thickness in mm, or MM,mean");
            sampling.slab_mm = *mm;
            sampling.slab = *of;
        },
        "Show the largest, mean or least value across a slab of this thickness");
}

} // namespace

void register_slice(CLI::App& app, Action& chosen) {
    auto flags = std::make_shared<SliceFlags>();
    CLI::App* command = add_command(app, "slice", "Draw a slice of a scan, with vessels on it");
    add_input(*command, "VOLUME", "", flags->file,
              "Scan: a volume (" + io::readable_volume_extensions() + "), or a folder of DICOM or TIFF files")
        ->required();
    add_option(*command, "-o,--output", "FILE", flags->output,
               "PNG to write; or the values in their place: " + io::value_map_extensions());
    std::map<std::string, slice::Direction> planes;
    for (const auto& [direction, name] : slice::kDirections) planes.emplace(name, direction);
    add_option(*command, "--plane", "NAME", flags->plane,
               "axial (default), coronal or sagittal, as radiologists see them, or oblique, across --normal")
        ->transform(CLI::CheckedTransformer(planes).description(""));
    add_vector_option(*command, "--at", flags->at,
                      "Place that the slice goes through, mm RAS (default: the middle of the scan)");
    add_vector_option(*command, "--normal", flags->normal, "Direction across an oblique slice");
    add_window_flag(*command, flags->window);
    add_slab_option(*command, flags->sampling);
    command->add_flag("--nearest", flags->nearest, "Show the value of the nearest voxel, without interpolation");
    add_input(*command, "--tree", "TREE", flags->tree, "Draw the section of this tree's surface and its centerlines");
    add_input(*command, "--mask", "MASK", flags->mask, "Tint the labels of this segmentation");
    add_mask_units_flag(*command, flags->mask_units, "--mask");
    add_option(*command, "--scan-units", "UNIT", flags->scan_units,
               "Unit of the scan's lengths, if not as its file says")
        ->check(expecting(" is not a unit of length: mm, um, cm or m",
                          [](const std::string& word) { return io::length_unit(word).has_value(); }));
    add_option_taking<std::string>(
        *command, "--size", "WxH",
        [flags](const std::string& word) {
            const auto size = size_in(word);
            if (!size) throw CLI::ValidationError("--size", size.error().message());
            flags->size = *size;
        },
        "Fit all of the scan into a picture of this size (default: a pixel for the smallest spacing of voxels)");
    command->add_flag("--plain", flags->plain, "Without letters, scale bar and caption");
    command->add_flag("--json", flags->json,
                      "Print plane, pixels, value at the place, and the outlines in mm with their branches");
    add_surface_flags(*command, flags->common);
    command->callback([command, flags, &chosen] {
        if (flags->output.empty() && !flags->json) throw CLI::RequiredError("-o or --json");
        const bool oblique = flags->plane == slice::Direction::kOblique;
        if (oblique != flags->normal.has_value())
            throw CLI::ValidationError("--normal",
                                       oblique ? "is needed for an oblique slice" : "needs --plane oblique");
        if (flags->normal && std::hypot((*flags->normal)[0], (*flags->normal)[1], (*flags->normal)[2]) == 0.0)
            throw CLI::ValidationError("--normal", "must have a direction");
        check_output_flags(*command, flags->output, {});
        chosen = [flags] { return with_output(*flags, run_slice); };
    });
}

} // namespace ramus::app
