// `ramus study FILE -o FOLDER`: draws the pictures of the paper's user study (sections V and VIII) for any tree: the
// whole tree and three close-ups, each as isosurface of the mask, as truncated cones and as convolution surface, with
// the same camera and light. Also writes rating pages, on which raters score such pictures without captions.
#include "app/commands/inputs.h"
#include "app/commands/picture_flags.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/surface_flags.h"
#include "app/picture/close_ups.h"
#include "app/picture/compose.h"
#include "app/ratings/rating_order.h"
#include "app/ratings/rating_page.h"
#include "app/session/checksum.h"
#include "app/session/error_context.h"
#include "app/session/numbers.h"
#include "app/workspace/compared_surfaces.h"
#include "core/io/output_file.h"
#include "core/io/output_folder.h"
#include "core/io/volumes/volume_file.h"
#include "core/tree/part_of_tree.h"
#include "render/gl/headless_context.h"
#include "render/overlay/scale_bar.h"
#include "render/renderer/renderer.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

namespace ramus::app {

namespace {

struct StudyFlags {
    SurfaceFlags common;
    std::string file, mask, mask_units;
    std::filesystem::path folder;
    std::vector<volume::LabelChoice> labels; // of the mask; empty: all
    glm::ivec2 size{1200, 900};
    render::View view = render::View::kAnterior;
    double voxel_mm = 0.0; // 0: estimated from the tree
    int raters = 1;
    std::uint64_t seed = 1; // of the orders that raters see
    bool json = false;
};

using Paged = std::shared_ptr<const render::PagedMesh>;

// The three surfaces of one tree.
struct Surfaces {
    struct One {
        std::string name, title; // in file names, in captions
        Paged mesh;
    };
    std::array<One, 3> all;
    double voxel_mm = 0.0; // of a mask made of the tree; 0: the mask was given
};

Result<Surfaces> make_surfaces(const StudyFlags& flags, const tree::VesselTree& tree) {
    Surfaces made;
    std::size_t index = 0;
    for (const auto& [kind, name] : {std::pair{Compared::kIsosurface, "isosurface"},
                                     {Compared::kTruncatedCones, "cones"},
                                     {Compared::kConvolutionSurface, "convolution"}}) {
        Marks marks;
        marks.options = flags.common.surface;
        marks.comparison.mask = flags.mask;
        marks.comparison.mask_units = flags.mask_units;
        marks.comparison.labels = flags.labels;
        ComparedRequest request = compared_request(marks, kind);
        request.voxel_mm = flags.voxel_mm;
        RAMUS_TRY(surface, with_progress(kind == Compared::kIsosurface ? "isosurface" : "surface",
                                         [&](Job& job) { return make_compared(tree, request, job); }));
        for (const std::string& note : surface.notes) say(flags.common, flags.mask + ": " + note);
        if (kind == Compared::kIsosurface) made.voxel_mm = surface.voxel_mm;
        const std::string title = kind == Compared::kIsosurface ? "Isosurface of the mask" : title_of(kind, {});
        made.all[index++] = {name, title, surface.mesh};
    }
    return made;
}

// Draws the pictures, in the size of the flags, and writes them.
class Painter {
public:
    Painter(render::Renderer& renderer, const StudyFlags& flags, const tree::Claims& claims, io::OutputSet& together)
        : renderer_(renderer), flags_(flags), claims_(claims), together_(together) {}

    [[nodiscard]] render::Frame frame(const Paged& mesh, const render::Camera& camera, std::string caption) const {
        render::Frame frame;
        frame.mesh = mesh;
        frame.camera = camera;
        frame.size = flags_.size;
        frame.overlays.caption = std::move(caption);
        show_claims(frame, claims_);
        return frame;
    }
    // All pictures with the same camera have the scale bar of the first one, so that it does not reveal the method.
    Result<render::Image> draw(render::Frame frame) {
        if (scale_of_ != frame.camera) {
            if (const auto drawn = renderer_.draw(frame); !drawn) return tl::unexpected(drawn.error());
            const auto depths = renderer_.read_depths();
            const auto visible = depths ? render::visible_in({&*depths, 1}) : std::nullopt;
            scale_ = visible ? render::scale_of(frame.camera, frame.size, *visible) : std::nullopt;
            scale_of_ = frame.camera;
        }
        frame.overlays.scale = scale_;
        if (const auto drawn = renderer_.draw(frame); !drawn) return tl::unexpected(drawn.error());
        if (const auto finer = renderer_.refine(); !finer) return tl::unexpected(finer.error());
        return renderer_.read_image();
    }
    Result<void> write(const render::Frame& frame, const std::string& name) {
        RAMUS_TRY(image, draw(frame));
        const auto path = flags_.folder / (name + ".png");
        if (auto written = render::write_png(image, path, &together_); !written) return written;
        files_.push_back(path.string());
        return {};
    }
    [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

private:
    render::Renderer& renderer_;
    const StudyFlags& flags_;
    tree::Claims claims_;                    // of the tree
    io::OutputSet& together_;                // where pictures are written
    std::optional<render::Camera> scale_of_; // the camera of `scale_`
    std::optional<render::Scale> scale_;
    std::vector<std::string> files_;
};

// A study and its pictures, which have no captions.
struct RatedPictures {
    RatingStudy study;
    StudyPngs pngs;
};

// A study view: the same view of all surfaces.
Result<void> add_view(RatedPictures& rated, Painter& painter, const Surfaces& surfaces, const render::Camera& camera,
                      const std::string& title) {
    StudyView view{title, {}};
    for (std::size_t method = 0; method < surfaces.all.size(); ++method) {
        render::Frame frame = painter.frame(surfaces.all[method].mesh, camera, {});
        frame.overlays.orientation_cube = false;
        RAMUS_TRY(image, painter.draw(frame));
        RAMUS_TRY(png, render::encode_png(image));
        // Includes the study view, and repeats if two methods give equal pictures: each code belongs to one picture.
        Checksum checksum;
        do checksum.add(title).add(png);
        while (rated.pngs.contains(checksum.text()));
        view.pictures.push_back({checksum.text(), method});
        rated.pngs[checksum.text()] = std::move(png);
    }
    std::ranges::sort(view.pictures, {}, &StudyPicture::code);
    rated.study.views.push_back(std::move(view));
    return {};
}

Result<std::vector<std::filesystem::path>> write_pages(RatedPictures& rated, const Surfaces& surfaces,
                                                       const StudyFlags& flags, io::OutputSet& together) {
    for (const Surfaces::One& one : surfaces.all) rated.study.methods.push_back({one.name, one.title});
    rated.study.method = surfaces.all.size() - 1;
    rated.study.seed = flags.seed;
    rated.study.orders = rater_orders(rated.study, flags.raters);
    return write_study(rated.study, rated.pngs, flags.folder, together);
}

// Creates FOLDER/sheets. Fails before anything is drawn if a file cannot be written.
Result<io::OutputFolder> make_folders(const std::filesystem::path& folder) {
    RAMUS_TRY(pages, io::OutputFolder::make(folder / "sheets"));
    for (const char* name : {"context.png", "key.json", "sheets/rater_001.html"})
        if (auto can = io::check_output(folder / name); !can) return tl::unexpected(can.error());
    return std::move(pages);
}

Result<int> run_study(const StudyFlags& flags) {
    io::note_input(flags.file);
    io::note_input(flags.mask);
    const auto pages_folder = make_folders(flags.folder); // removes new folders again if nothing is written
    if (!pages_folder) return tl::unexpected(pages_folder.error());
    RAMUS_TRY(whole_tree, load_tree(flags.file, flags.common));
    RAMUS_TRY(chosen, branches_of(whole_tree, Marks(), flags.common.systems, flags.file));
    const bool all = std::ranges::find(chosen, 0) == chosen.end();
    const tree::VesselTree tree = all ? std::move(whole_tree) : tree::part_of(whole_tree, chosen);
    RAMUS_TRY(surfaces, with_file(make_surfaces(flags, tree), flags.file));
    const auto context = render::make_headless_context(render::Backend::kOsMesa, std::nullopt);
    if (!context) return tl::unexpected(context.error());
    RAMUS_TRY(renderer, render::Renderer::create());

    io::OutputSet together;
    Painter painter(*renderer, flags, tree.claims, together);
    const Paged& smooth = surfaces.all[2].mesh;
    const render::Frame whole =
        painter.frame(smooth, render::camera_for(smooth->positions(), flags.view, flags.size), surfaces.all[2].title);
    if (auto done = painter.write(whole, "context"); !done) return tl::unexpected(done.error());
    const std::vector<CloseUp> close_ups = choose_close_ups(*renderer, whole, close_ups_of(tree));
    RatedPictures rated;
    if (auto done = add_view(rated, painter, surfaces, whole.camera, "The whole tree"); !done)
        return tl::unexpected(done.error());
    nlohmann::ordered_json report;
    report["mask"] = flags.mask.empty() ? "made of the tree" : flags.mask;
    if (surfaces.voxel_mm > 0.0) report["voxel_mm"] = surfaces.voxel_mm;
    report["places"] = nlohmann::json::array();
    for (std::size_t i = 0; i < close_ups.size(); ++i) {
        const render::Camera camera = close_to(close_ups[i], whole.camera);
        for (const auto& [name, title, mesh] : surfaces.all) {
            render::Frame frame = painter.frame(mesh, camera, title);
            frame.overlays.orientation_cube = false;
            if (auto done = painter.write(frame, "place_" + std::to_string(i + 1) + "_" + name); !done)
                return tl::unexpected(done.error());
        }
        const double diameter_mm = 2.0 * close_ups[i].radius;
        if (auto done = add_view(rated, painter, surfaces, camera,
                                 "Close-up, vessel " + Lengths(tree.claims).text(diameter_mm) + " wide");
            !done)
            return tl::unexpected(done.error());
        report["places"].push_back({{"diameter_mm", diameter_mm}, {"camera", render::to_json(camera)}});
    }
    RAMUS_TRY(page_files, write_pages(rated, surfaces, flags, together));
    if (auto written = together.commit(); !written) return tl::unexpected(written.error());
    for (const std::string& file : painter.files()) say(flags.common, "wrote " + file);
    report["pictures"] = painter.files();
    report["study"] = id_of(rated.study);
    report["key"] = (flags.folder / "key.json").string();
    for (const auto& file : page_files) report["sheets"].push_back(file.string());
    if (flags.json)
        std::cout << printed_report(std::move(report), tree.claims) << '\n';
    else
        std::cout << flags.folder.string() << ": " << counted(painter.files().size(), "picture", "pictures") << ", "
                  << counted(page_files.size(), "rating page", "rating pages") << '\n';
    return kDone;
}

} // namespace

void register_study(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<StudyFlags>();
    CLI::App* command = add_command(
        app, "study", "Pictures to compare surfaces by (isosurface, cones, convolution surface), and rating pages");
    add_input(*command, "FILE", "", flags->file, "Vessel tree")->required();
    add_option(*command, "-o,--output", "FOLDER", flags->folder,
               "Folder for the pictures; created if it does not exist")
        ->required();
    CLI::Option* mask = add_input(*command, "--mask", "MASK", flags->mask,
                                  "Segmentation mask of the same vessels (" + io::readable_volume_extensions() + ")");
    add_mask_units_flag(*command, flags->mask_units, "--mask")->needs(mask);
    add_label_flag(*command, flags->labels, "Labels of the mask that are these vessels (default: all)")->needs(mask);
    add_option(
        *command, "--voxel", "MM", flags->voxel_mm,
        "Size of the voxels of the mask that is made of the tree without --mask (default: estimated from the tree)")
        ->check(CLI::PositiveNumber.description(""))
        ->excludes(mask);
    add_size_flag(*command, flags->size);
    add_view_flag(*command, flags->view);
    add_option(*command, "--raters", "N", flags->raters,
               "Rating pages in FOLDER/sheets, one for each rater (default: 1)")
        ->check(CLI::Range(1, kMostRaters).description(""));
    add_option(*command, "--seed", "S", flags->seed,
               "Seed of the orders in which raters see the pictures (default: 1)");
    command->add_flag("--json", flags->json, "Print what was done as one JSON object");
    add_surface_flags(*command, flags->common);
    add_system_flag(*command, flags->common);
    command->callback([flags, &chosen] { chosen = [flags] { return run_study(*flags); }; });
}

} // namespace ramus::app
