#include "app/picture/figures.h"

#include "app/picture/colouring.h"
#include "app/picture/video_file.h"
#include "core/io/output_file.h"
#include "render/image/text.h"
#include "render/overlay/overlay.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace ramus::app {

namespace {

void dress(render::Frame& frame, const FigureOptions& options) {
    const auto shows = [&](const char* name) {
        return std::ranges::find(options.overlays, name) != options.overlays.end();
    };
    frame.overlays.caption = latin1(options.caption);
    frame.pixel_ratio *= static_cast<float>(options.text_size);
    if (options.ground) put_on(frame, *options.ground);
    if (!options.overlays_given) return;
    frame.overlays.orientation_cube = shows("cube");
    frame.overlays.scale_bar = shows("scale");
    frame.overlays.orientation_letters = shows("letters");
    if (!shows("legend")) frame.overlays.legend = {};
}

Result<void> check_enlarged(glm::ivec2 size, const FigureOptions& options) {
    auto fits = render::check_size(size.x, size.y);
    if (!fits && options.supersample > 1) fits.error().hint += "; or a smaller --supersample";
    return fits;
}

// A heading is placed below the caption of its own viewport; this moves headings of other viewports, and of a blend,
// down as well.
void make_room_for_caption(render::Sheet& sheet) {
    const render::Sheet::Viewport& first = sheet.viewports.front();
    const int bottom = render::OverlayPainter().caption_bottom(render::SpriteSource(first.frame));
    if (bottom == 0) return;
    if (sheet.blend) sheet.heading_top = std::max(sheet.heading_top, bottom);
    for (std::size_t i = 1; i < sheet.viewports.size() && !sheet.blend; ++i) {
        render::Overlays& overlays = sheet.viewports[i].frame.overlays;
        if (sheet.viewports[i].at.y == first.at.y && overlays.caption.empty() && !overlays.heading.empty())
            overlays.inset_top = std::max(overlays.inset_top, bottom);
    }
}

void enlarge(render::Frame& frame, const FigureOptions& options) {
    frame.size *= options.supersample;
    frame.pixel_ratio *= static_cast<float>(options.supersample);
    for (int* inset : {&frame.overlays.inset_left, &frame.overlays.inset_top, &frame.overlays.inset_right,
                       &frame.overlays.inset_bottom})
        *inset *= options.supersample;
}

// Finer pixels over the same part of the patient.
void enlarge(render::SliceView& slice, const FigureOptions& options) {
    const int times = options.supersample;
    slice::PixelGrid& grid = slice.grid;
    const glm::dvec3 edge = grid.place(glm::dvec2(-0.5)); // the corner of the first pixel
    grid.right /= times;
    grid.down /= times;
    grid.corner = edge + 0.5 * (grid.right + grid.down);
    grid.size *= times;
    slice.pixel_ratio *= static_cast<float>(times);
    slice.overlays.inset_top *= times;
}

// The tree of a picture with slices, over all of it.
void leave_slices_out(render::Sheet& sheet) {
    const auto is_slice = [](const render::Sheet::Viewport& one) { return one.slice.has_value(); };
    if (std::ranges::none_of(sheet.viewports, is_slice)) return;
    sheet.viewports.resize(1);
    sheet.viewports.front().slice.reset();
    sheet.viewports.front().at = glm::ivec2(0);
    sheet.viewports.front().frame.size = sheet.size;
}

constexpr std::array kViews{render::View::kAnterior, render::View::kLeft, render::View::kPosterior,
                            render::View::kSuperior};

// Moves the cameras to the same distance from the middle of `box`, at which it fits all pictures.
std::vector<render::Camera> at_one_scale(std::vector<render::Camera> cameras, const render::Box& box, glm::ivec2 size) {
    constexpr double kMargin = 1.05;
    const double aspect = double(size.x) / size.y;
    double distance = 0.0, scale = 0.0;
    for (const render::Camera& camera : cameras) {
        const render::CameraAxes axes = render::axes_of(camera);
        const double slope = std::tan(glm::radians(0.5 * camera.view_angle));
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 high((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
            const glm::dvec3 off = glm::mix(box.lower, box.upper, high) - box.centre();
            const double across =
                std::max(std::abs(glm::dot(off, axes.right)) / aspect, std::abs(glm::dot(off, axes.up)));
            distance = std::max(distance, kMargin * across / slope - glm::dot(off, axes.forward));
            scale = std::max(scale, kMargin * across);
        }
    }
    for (render::Camera& camera : cameras) {
        const glm::dvec3 forward = render::axes_of(camera).forward;
        camera.focal_point = box.centre();
        camera.position = box.centre() - std::max(distance, 1e-6) * forward;
        camera.scale = std::max(scale, 1e-9);
    }
    return cameras;
}

void include_context(render::Box& box, const render::Frame& frame) {
    for (const render::ContextMesh& item : frame.context) {
        const render::Box bounds = item.shown() ? render::bounds_of(*item.mesh) : render::Box();
        if (bounds.empty()) continue;
        box.include(bounds.lower);
        box.include(bounds.upper);
    }
}

// Bounding box of the visible surfaces in the viewports; without surfaces, of the visible objects.
render::Box visible_box(const render::Sheet& sheet) {
    constexpr std::array kAlongAxes{glm::dvec3(1, 0, 0),  glm::dvec3(0, 1, 0),  glm::dvec3(0, 0, 1),
                                    glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1)};
    render::Box visible, all;
    for (const auto& [at, frame, has_branches, slice] : sheet.viewports) {
        if (slice) continue;
        if (!frame.mesh) {
            include_context(all, frame);
            continue;
        }
        const auto positions = frame.mesh->farthest(kAlongAxes, [&states = frame.states](int branch) {
            const auto index = static_cast<std::size_t>(branch);
            return index >= states.size() || states[index] != tree::BranchState::kHidden;
        });
        for (const glm::vec3& position : positions) visible.include(glm::dvec3(position));
        if (const render::Box& bounds = frame.mesh->bounds(); !bounds.empty()) {
            all.include(bounds.lower);
            all.include(bounds.upper);
        }
    }
    return visible.empty() ? all : visible;
}

void look_from(render::Sheet& sheet, const render::Camera& camera) {
    for (render::Sheet::Viewport& viewport : sheet.viewports) viewport.frame.camera = camera;
}

// A grid of parts of equal size.
struct Grid {
    glm::ivec2 size, count;
    int line; // smallest distance in pixels
    [[nodiscard]] glm::ivec2 part() const { return (size - line * (count - 1)) / count; }
    // The remainder of the division goes between them.
    [[nodiscard]] glm::ivec2 at(int index) const {
        const glm::ivec2 cell(index % count.x, index / count.x);
        return cell * (size - part()) / glm::max(count - 1, glm::ivec2(1));
    }
};

bool side_by_side(const render::Sheet& sheet) { return sheet.viewports.size() > 1 && !sheet.blend; }

Grid grid_for(const render::Sheet& sheet, glm::ivec2 size) {
    if (!side_by_side(sheet)) return {size, {2, 2}, 0};
    const auto views = static_cast<int>(kViews.size());
    return {size, size.x >= size.y ? glm::ivec2(views, 1) : glm::ivec2(1, views), 1};
}

// "Anterior", "From +y"; "anterior" after other words.
std::string title_of(render::View view, bool first, bool sides_known) {
    std::string name = render::title_of(view, sides_known);
    if (!first) name.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
    return name;
}

// Labels each cell. In a table of views and surfaces, labels rows and columns.
void label(render::Sheet& sheet, std::size_t view, bool table) {
    const std::string caption = sheet.viewports.front().frame.overlays.caption; // of the whole sheet
    for (std::size_t i = 0; i < sheet.viewports.size(); ++i) {
        render::Overlays& overlays = sheet.viewports[i].frame.overlays;
        std::string words;
        if (side_by_side(sheet) && (view == 0 || !table)) words = overlays.heading;
        if (!side_by_side(sheet) || i == 0 || !table)
            words += (words.empty() ? "" : ", ") +
                     title_of(kViews[view], words.empty(), overlays.axes != render::plain_axes());
        if (view == 0 && (i == 0 || sheet.blend) && !caption.empty()) words.insert(0, caption + ": ");
        overlays.caption = words;
        if (view > 0 || side_by_side(sheet)) overlays.heading.clear();
        if (view > 0) overlays.legend = {};
    }
    if (view > 0) sheet.heading.clear();
}

// The window shows an interactive picture only from the second moving view on.
Result<void> draw_moving(render::SheetRenderer& renderer, render::Sheet& sheet) {
    const render::Camera there = sheet.viewports.front().frame.camera;
    for (render::Sheet::Viewport& viewport : sheet.viewports) viewport.frame.quality = render::Quality::kInteractive;
    for (const double turn : {1.0, 0.0}) {
        look_from(sheet, render::turned(there, turn, 0.0));
        if (const auto drawn = renderer.draw(sheet); !drawn) return tl::unexpected(drawn.error());
    }
    return {};
}

// Keeps the scale bar if it is common to all pictures.
void keep_common(std::optional<render::ScaleBar>& common, const std::optional<render::ScaleBar>& next, bool first) {
    if (first)
        common = next;
    else if (common != next)
        common.reset();
}

} // namespace

void dress(render::Sheet& sheet, const FigureOptions& options) {
    for (std::size_t i = 0; i < sheet.viewports.size(); ++i) {
        render::Overlays& overlays = sheet.viewports[i].frame.overlays;
        const render::Overlays shared = overlays; // overlays that viewports share
        dress(sheet.viewports[i].frame, options);
        if (sheet.viewports.size() == 1 || sheet.blend) continue;
        overlays.orientation_cube &= i + 1 == sheet.viewports.size();
        overlays.scale_bar &= i == 0;
        if (i > 0) overlays.caption = shared.caption;
    }
}

Result<Figure> draw_figure(render::SheetRenderer& renderer, render::Sheet sheet, const FigureOptions& options) {
    sheet.size *= options.supersample;
    sheet.heading_top *= options.supersample;
    for (render::Sheet::Viewport& viewport : sheet.viewports) {
        viewport.at *= options.supersample;
        enlarge(viewport.frame, options);
        if (viewport.slice) enlarge(*viewport.slice, options);
    }
    make_room_for_caption(sheet);
    if (auto fits = check_enlarged(sheet.size, options); !fits) return tl::unexpected(fits.error());
    if (const auto drawn = renderer.draw_with_scale(sheet); !drawn) return tl::unexpected(drawn.error());
    if (options.moving) {
        if (const auto moved = draw_moving(renderer, sheet); !moved) return tl::unexpected(moved.error());
    } else if (options.samples > 4 && options.supersample == 1)
        if (const auto finer = renderer.refine(sheet); !finer) return tl::unexpected(finer.error());
    Figure figure{render::reduced(renderer.read_image(), options.supersample), renderer.scale_bar()};
    if (figure.scale_bar) figure.scale_bar->pixels /= options.supersample;
    return figure;
}

Result<FourViews> four_views(const ComposeSheet& compose, glm::ivec2 size, const FigureOptions& options) {
    RAMUS_TRY(whole, compose(size));
    leave_slices_out(whole); // the same in each view
    const Grid grid = grid_for(whole, size);
    const glm::ivec2 part = grid.part();
    const auto viewports = static_cast<int>(side_by_side(whole) ? whole.viewports.size() : 1);
    if (part.x < 1 || part.y < 1 || std::max(part.x, part.y) < 2 * viewports - 1)
        return fail("a sheet of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                        " pixels has no room for four views",
                    {}, "give a larger --size");
    RAMUS_TRY(composed, compose(part));
    leave_slices_out(composed);
    dress(composed, options);
    std::vector<render::Camera> cameras;
    for (const render::View view : kViews)
        cameras.push_back(render::looking(composed.viewports.front().frame.camera, view));
    cameras = at_one_scale(std::move(cameras), visible_box(composed), composed.viewports.front().frame.size);
    // Views and surfaces are arranged in different directions, unless the picture is very long.
    const bool below = composed.viewports.back().at.y > 0;
    const bool table = side_by_side(composed) && below == (grid.count.x > 1);
    FourViews all{render::Image(size.x, size.y), {}};
    if (side_by_side(composed) && !composed.viewports.front().frame.background.transparent)
        all.ground.fill(composed.divider);
    for (std::size_t i = 0; i < kViews.size(); ++i) {
        all.views.push_back({composed, grid.at(static_cast<int>(i))});
        look_from(all.views.back().sheet, cameras[i]);
        label(all.views.back().sheet, i, table);
    }
    return all;
}

Result<Figure> draw_four_views(render::SheetRenderer& renderer, const ComposeSheet& compose, glm::ivec2 size,
                               const FigureOptions& options) {
    RAMUS_TRY(all, four_views(compose, size, options));
    Figure picture{std::move(all.ground), {}};
    for (std::size_t i = 0; i < all.views.size(); ++i) {
        auto part_of_it = draw_figure(renderer, std::move(all.views[i].sheet), options);
        if (!part_of_it) return part_of_it;
        picture.image.put(part_of_it->image, all.views[i].at);
        keep_common(picture.scale_bar, part_of_it->scale_bar, i == 0);
    }
    return picture;
}

namespace {

std::vector<render::Camera> cameras_around(const render::Sheet& sheet, const FigureOptions& options) {
    const render::Frame& first = sheet.viewports.front().frame;
    std::vector<render::Camera> cameras;
    for (int i = 0; i < options.turntable; ++i)
        cameras.push_back(render::turned(first.camera, 360.0 * i / options.turntable, 0.0));
    return options.whole ? at_one_scale(std::move(cameras), visible_box(sheet), first.size) : cameras;
}

} // namespace

std::filesystem::path numbered(const std::filesystem::path& output, int index, int count) {
    const std::size_t digits = std::max<std::size_t>(3, std::to_string(count).size());
    std::string number = std::to_string(index + 1);
    number.insert(0, digits - number.size(), '0');
    return output.parent_path() / (output.stem().string() + "_" + number + output.extension().string());
}

void look_around(render::Sheet& sheet, const FigureOptions& options, std::size_t picture) {
    look_from(sheet, cameras_around(sheet, options)[picture]);
}

Result<Turntable> write_turntable(render::SheetRenderer& renderer, const render::Sheet& sheet,
                                  const FigureOptions& options, const std::filesystem::path& output, Job& job) {
    if (sheet.viewports.front().slice)
        return fail("a slice alone does not turn", output.string(),
                    "choose a layout with the tree: picture, slices or large");
    std::optional<VideoFile> video;
    if (is_video(output)) {
        if (sheet.viewports.front().frame.background.transparent)
            return fail("a video has no transparent background", output.string(), "choose dark, grey or white");
        RAMUS_TRY(made, VideoFile::create(output, sheet.size, options.frames_a_second));
        video.emplace(std::move(made));
    }
    Turntable table;
    io::OutputSet pictures;
    const std::vector<render::Camera> cameras = cameras_around(sheet, options);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        if (job.cancelled()) return fail("cancelled");
        job.report(static_cast<float>(i) / static_cast<float>(cameras.size()));
        render::Sheet one = sheet;
        look_from(one, cameras[i]);
        RAMUS_TRY(figure, draw_figure(renderer, std::move(one), options));
        keep_common(table.scale_bar, figure.scale_bar, i == 0);
        const auto file = numbered(output, static_cast<int>(i), options.turntable);
        const auto written = video ? video->add(figure.image) : render::write_png(figure.image, file, &pictures);
        if (!written) return tl::unexpected(written.error());
        if (!video) table.files.push_back(file);
    }
    if (video) {
        if (auto ended = video->commit(job); !ended) return tl::unexpected(ended.error());
        table.files.push_back(output);
    } else if (auto written = pictures.commit(); !written) {
        return tl::unexpected(written.error());
    }
    return table;
}

Result<void> write_figure(render::SheetRenderer& renderer, const ComposeSheet& compose, glm::ivec2 size,
                          const FigureRequest& request, Job& job) {
    const FigureOptions& options = request.options;
    const auto write = [&](const Result<Figure>& figure) {
        return figure ? render::write_png(figure->image, request.file) : tl::unexpected(figure.error());
    };
    size = request.size.value_or(size);
    if (options.sheet) return write(draw_four_views(renderer, compose, size, options));
    RAMUS_TRY(sheet, compose(size));
    dress(sheet, options);
    if (options.turntable == 0) return write(draw_figure(renderer, std::move(sheet), options));
    const auto table = write_turntable(renderer, sheet, options, request.file, job);
    return table ? Result<void>() : tl::unexpected(table.error());
}

} // namespace ramus::app
