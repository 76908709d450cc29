#include "app/paper/plate.h"

#include "app/picture/colouring.h"
#include "app/picture/ground.h"
#include "render/gl/headless_context.h"
#include "render/renderer/sheet.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::app::paper {

namespace {

constexpr int kGap = 6;          // pixels between panels
constexpr int kInsetMargin = 10; // pixels around an inset
constexpr glm::vec3 kFrameColour{0.28F, 0.32F, 0.37F};

// The border of a rectangle, inside of it.
void outline(render::Image& image, glm::ivec2 at, glm::ivec2 size, int width) {
    const glm::ivec2 whole(image.width, image.height);
    const glm::ivec2 low = glm::clamp(at, glm::ivec2(0), whole), high = glm::clamp(at + size, glm::ivec2(0), whole);
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
            const bool inner =
                x >= at.x + width && x < at.x + size.x - width && y >= at.y + width && y < at.y + size.y - width;
            if (inner) continue;
            for (int channel = 0; channel < 3; ++channel)
                image.pixel(x, y)[channel] = static_cast<std::uint8_t>(std::lround(255.0F * kFrameColour[channel]));
        }
}

bool looks_alike(const render::Camera& a, const render::Camera& b) {
    constexpr double kSame = 0.9999;
    return a.orthographic && b.orthographic && glm::dot(render::axes_of(a).forward, render::axes_of(b).forward) > kSame;
}

// What the inset shows, in the picture of the panel.
void mark_inset(render::Image& image, const render::Frame& frame, const render::Frame& inset) {
    const auto middle = render::project(frame.camera, frame.size, inset.camera.focal_point);
    if (!looks_alike(frame.camera, inset.camera) || !middle) return;
    const double half_height = inset.camera.scale / render::mm_per_pixel(frame.camera, frame.size);
    const glm::dvec2 half(half_height * inset.size.x / inset.size.y, half_height);
    outline(image, glm::ivec2(glm::round(glm::dvec2(*middle) - half)), glm::ivec2(glm::round(2.0 * half)), 2);
}

} // namespace

render::Frame frame_of(Paged mesh, const render::Camera& camera, glm::ivec2 size, const std::string& caption) {
    render::Frame frame;
    frame.mesh = std::move(mesh);
    frame.camera = camera;
    frame.size = size;
    frame.overlays.caption = latin1(caption);
    frame.overlays.orientation_cube = false;
    put_on(frame, Ground::kWhite);
    return frame;
}

render::Camera camera_on(std::span<const Paged> surfaces, glm::ivec2 size, const Looking& looking) {
    std::vector<glm::vec3> positions;
    for (const Paged& surface : surfaces) {
        const std::vector<glm::vec3> more = surface->positions();
        positions.insert(positions.end(), more.begin(), more.end());
    }
    const glm::ivec2 taken(static_cast<int>(std::lround(looking.share * size.x)), size.y);
    render::Camera camera = render::camera_for(positions, render::View::kAnterior, taken, true);
    camera = render::fitted(render::turned(camera, looking.azimuth, looking.elevation), positions, taken);
    constexpr double kRoom = 1.12; // for words and the scale bar
    camera.scale *= kRoom;
    const glm::dvec3 aside =
        0.5 * (size.x - taken.x) * render::mm_per_pixel(camera, size) * render::axes_of(camera).right;
    camera.focal_point += aside;
    camera.position += aside;
    return camera;
}

render::Camera magnified(render::Camera camera, const glm::dvec3& at, double height_mm) {
    camera = render::centred_on(camera, at);
    camera.scale = 0.5 * height_mm;
    return camera;
}

Result<std::unique_ptr<Artist>> Artist::create() {
    std::unique_ptr<Artist> artist(new Artist);
    RAMUS_TRY(context, render::make_headless_context(render::Backend::kOsMesa, std::nullopt));
    artist->context_ = std::move(context);
    RAMUS_TRY(renderer, render::Renderer::create());
    artist->renderer_ = std::move(renderer);
    return artist;
}

Result<render::Image> Artist::draw(const render::Frame& frame) {
    render::SheetRenderer renderer(*renderer_);
    const render::Sheet sheet = render::sheet_of(frame);
    if (const auto drawn = renderer.draw_with_scale(sheet); !drawn) return tl::unexpected(drawn.error());
    if (const auto finer = renderer.refine(sheet); !finer) return tl::unexpected(finer.error());
    return renderer.read_image();
}

Result<render::Image> Artist::draw(const Panel& panel) {
    RAMUS_TRY(image, draw(panel.frame));
    if (!panel.inset) return std::move(image);
    RAMUS_TRY(inset, draw(*panel.inset));
    outline(inset, glm::ivec2(0), panel.inset->size, 2);
    mark_inset(image, panel.frame, *panel.inset);
    image.put(inset, panel.frame.size - panel.inset->size - glm::ivec2(kInsetMargin));
    return std::move(image);
}

Result<render::Image> Artist::draw(const Plate& plate, Job& job) {
    const glm::ivec2 size = plate.panels.front().frame.size;
    const auto columns = static_cast<int>(plate.columns);
    const auto count = static_cast<int>(plate.panels.size());
    const glm::ivec2 cells(std::min(columns, count), (count + columns - 1) / columns);
    const glm::ivec2 whole = cells * size + (cells - 1) * kGap;
    render::Image image(whole.x, whole.y);
    image.fill(glm::vec3(0.84F, 0.86F, 0.88F));
    for (int index = 0; index < count; ++index) {
        if (job.cancelled()) return fail("cancelled");
        RAMUS_TRY(drawn, draw(plate.panels[static_cast<std::size_t>(index)]));
        image.put(drawn, glm::ivec2(index % columns, index / columns) * (size + kGap));
        job.report(static_cast<float>(index + 1) / static_cast<float>(count));
    }
    return image;
}

} // namespace ramus::app::paper
