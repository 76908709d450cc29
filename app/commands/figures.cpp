#include "app/commands/figures.h"

#include "app/picture/colouring.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace ramus::app {

namespace {

// The cameras around the middle of `box`, all at the distance from which it is in the picture of each of them.
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

// A box around what can be seen of the frame's mesh.
render::Box visible_box(const render::Frame& frame) {
    render::Box box;
    const auto positions = frame.mesh->positions([&](int branch) {
        const auto index = static_cast<std::size_t>(branch);
        return index >= frame.states.size() || frame.states[index] != render::BranchState::kHidden;
    });
    for (const glm::vec3& position : positions) box.include(glm::dvec3(position));
    return box.empty() ? frame.mesh->bounds() : box;
}

std::string title_of(render::View view) {
    std::string name(render::name_of(view));
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    return name;
}

} // namespace

void add_figure_flags(CLI::App& command, FigureFlags& flags) {
    command
        .add_option("--supersample", flags.supersample,
                    "Draw N times as large and take the mean: smoother edges (default 1)")
        ->type_name("N")
        ->check(CLI::Range(1, 8).description(""));
    command.add_option("--caption", flags.caption, "Words at the top left")->type_name("TEXT");
    CLI::Option* overlays =
        command
            .add_option("--overlays", flags.overlays,
                        "What lies over the tree: none, or some of cube,scale,legend,letters (default "
                        "cube,scale,legend)")
            ->type_name("LIST")
            ->delimiter(',')
            ->check(CLI::IsMember({"cube", "scale", "legend", "letters", "none"}).description(""));
    overlays->each([&flags](const std::string&) { flags.overlays_given = true; });
    CLI::Option* sheet =
        command.add_flag("--sheet", flags.sheet, "Four views on one sheet: anterior, left, posterior, superior");
    command
        .add_option("--turntable", flags.turntable,
                    "Once around the tree in N pictures: o.png becomes o_001.png and so on")
        ->type_name("N")
        ->check(CLI::Range(2, 9999).description(""))
        ->excludes(sheet);
}

void dress(render::Frame& frame, const FigureFlags& flags) {
    const auto wanted = [&](const char* name) {
        return std::ranges::find(flags.overlays, name) != flags.overlays.end();
    };
    frame.overlays.caption = latin1(flags.caption);
    if (!flags.overlays_given) return;
    frame.overlays.orientation_cube = wanted("cube");
    frame.overlays.scale_bar = wanted("scale");
    frame.overlays.orientation_letters = wanted("letters");
    if (!wanted("legend")) frame.overlays.legend = {};
}

void dress(render::Sheet& sheet, const FigureFlags& flags) {
    for (std::size_t i = 0; i < sheet.panes.size(); ++i) {
        render::Overlays& overlays = sheet.panes[i].frame.overlays;
        const render::Overlays shared = overlays; // what panes beside each other have once, they have once
        dress(sheet.panes[i].frame, flags);
        if (sheet.panes.size() == 1 || sheet.blend) continue;
        overlays.orientation_cube &= i + 1 == sheet.panes.size();
        overlays.scale_bar &= i == 0;
        if (i > 0) overlays.caption = shared.caption;
    }
}

namespace {

Result<void> check_enlarged(glm::ivec2 size, const FigureFlags& flags) {
    auto fits = render::check_size(size.x, size.y);
    if (!fits && flags.supersample > 1) fits.error().hint += "; or a smaller --supersample";
    return fits;
}

void enlarge(render::Frame& frame, const FigureFlags& flags) {
    frame.size *= flags.supersample;
    frame.pixel_ratio *= static_cast<float>(flags.supersample);
    for (int* inset : {&frame.overlays.inset_left, &frame.overlays.inset_top, &frame.overlays.inset_right,
                       &frame.overlays.inset_bottom})
        *inset *= flags.supersample;
}

} // namespace

Result<render::Image> draw_figure(render::SheetRenderer& renderer, render::Sheet sheet, const FigureFlags& flags) {
    sheet.size *= flags.supersample;
    sheet.heading_top *= flags.supersample;
    for (render::Sheet::Pane& pane : sheet.panes) {
        pane.at *= flags.supersample;
        enlarge(pane.frame, flags);
    }
    if (auto fits = check_enlarged(sheet.size, flags); !fits) return tl::unexpected(fits.error());
    if (const auto drawn = renderer.draw(sheet); !drawn) return tl::unexpected(drawn.error());
    return render::reduced(renderer.read_image(), flags.supersample);
}

Result<render::Image> draw_figure(render::Renderer& renderer, render::Frame frame, const FigureFlags& flags) {
    enlarge(frame, flags);
    if (auto fits = check_enlarged(frame.size, flags); !fits) return tl::unexpected(fits.error());
    if (const auto drawn = renderer.draw(frame); !drawn) return tl::unexpected(drawn.error());
    return render::reduced(renderer.read_image(), flags.supersample);
}

Result<render::Image> draw_sheet(render::Renderer& renderer, const render::Frame& frame, const FigureFlags& flags) {
    constexpr std::array kSheet{render::View::kAnterior, render::View::kLeft, render::View::kPosterior,
                                render::View::kSuperior};
    const glm::ivec2 cell = frame.size / 2;
    if (cell.x < 1 || cell.y < 1) return fail("a sheet of one pixel has no room for four views");
    std::vector<render::Camera> cameras;
    for (const render::View view : kSheet) cameras.push_back(render::looking(frame.camera, view));
    cameras = at_one_scale(std::move(cameras), visible_box(frame), cell);
    render::Image sheet(frame.size.x, frame.size.y);
    for (std::size_t i = 0; i < kSheet.size(); ++i) {
        render::Frame one = frame;
        one.size = cell;
        one.camera = cameras[i];
        const std::string title = title_of(kSheet[i]);
        one.overlays.caption =
            i == 0 && !frame.overlays.caption.empty() ? frame.overlays.caption + ": " + title : title;
        if (i > 0) one.overlays.legend = {};
        const auto image = draw_figure(renderer, one, flags);
        if (!image) return image;
        // Cells of odd sheets leave a line of pixels in the middle.
        const int left = i % 2 == 0 ? 0 : sheet.width - cell.x, top = i < 2 ? 0 : sheet.height - cell.y;
        for (int y = 0; y < cell.y; ++y)
            std::memcpy(sheet.pixel(left, top + y), image->pixel(0, y), 4 * static_cast<std::size_t>(cell.x));
    }
    return sheet;
}

Result<std::vector<std::filesystem::path>> write_turntable(render::Renderer& renderer, const render::Frame& frame,
                                                           const FigureFlags& flags, bool keep_camera,
                                                           const std::filesystem::path& output) {
    std::vector<render::Camera> cameras;
    for (int i = 0; i < flags.turntable; ++i)
        cameras.push_back(render::turned(frame.camera, 360.0 * i / flags.turntable, 0.0));
    if (!keep_camera) cameras = at_one_scale(std::move(cameras), visible_box(frame), frame.size);
    const std::size_t digits = std::max<std::size_t>(3, std::to_string(flags.turntable).size());
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        render::Frame one = frame;
        one.camera = cameras[i];
        const auto image = draw_figure(renderer, one, flags);
        if (!image) return tl::unexpected(image.error());
        std::string number = std::to_string(i + 1);
        number.insert(0, digits - number.size(), '0');
        const auto file = output.parent_path() / (output.stem().string() + "_" + number + output.extension().string());
        if (auto written = render::write_png(*image, file); !written) return tl::unexpected(written.error());
        files.push_back(file);
    }
    return files;
}

} // namespace ramus::app
