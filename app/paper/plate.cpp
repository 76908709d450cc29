#include "app/paper/plate.h"

#include "app/picture/colouring.h"
#include "app/picture/ground.h"
#include "render/gl/headless_context.h"
#include "render/image/text.h"
#include "render/renderer/sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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

// What `part` shows, in the picture of `frame`.
void mark(render::Image& image, const render::Frame& frame, const render::Frame& part) {
    const auto middle = render::project(frame.camera, frame.size, part.camera.focal_point);
    if (!looks_alike(frame.camera, part.camera) || !middle) return;
    const double half_height = part.camera.scale / render::mm_per_pixel(frame.camera, frame.size);
    const glm::dvec2 half(half_height * part.size.x / part.size.y, half_height);
    outline(image, glm::ivec2(glm::round(glm::dvec2(*middle) - half)), glm::ivec2(glm::round(2.0 * half)), 2);
}

// The caption of a panel on white, `size` large.
render::Image heading(const std::string& caption, glm::ivec2 size) {
    constexpr int kLeft = 12;
    constexpr double kCapital = 9.5; // points
    render::Image image(size.x, size.y);
    image.fill(glm::vec3(1.0F));
    const render::Coverage words = render::draw_text(caption, kCapital * kPlateRatio);
    const int top = std::max(0, (size.y - words.height) / 2);
    for (int y = 0; y < std::min(words.height, size.y - top); ++y)
        for (int x = 0; x < std::min(words.width, size.x - kLeft); ++x)
            std::fill_n(image.pixel(kLeft + x, top + y), 3, static_cast<std::uint8_t>(255 - words.at(x, y)));
    return image;
}

} // namespace

render::Frame frame_of(Paged mesh, const render::Camera& camera, glm::ivec2 size, const std::string& caption) {
    render::Frame frame;
    frame.mesh = std::move(mesh);
    frame.camera = camera;
    frame.size = size;
    frame.pixel_ratio = kPlateRatio;
    frame.overlays.caption = latin1(caption);
    frame.overlays.orientation_cube = false;
    put_on(frame, Ground::kWhite);
    return frame;
}

render::Camera camera_on(const std::vector<Paged>& surfaces, glm::ivec2 size, const Looking& looking) {
    std::vector<glm::vec3> positions;
    for (const Paged& surface : surfaces) {
        const std::vector<glm::vec3> more = surface->positions();
        positions.insert(positions.end(), more.begin(), more.end());
    }
    constexpr int kAround = 10, kScaleBar = 68; // pixels
    const glm::ivec2 free(static_cast<int>(std::lround((1.0 - looking.left - looking.right) * size.x)) - 2 * kAround,
                          size.y - kAround - kScaleBar);
    render::Camera camera = render::camera_for(positions, render::View::kAnterior, free, true);
    camera = render::fitted(render::turned(camera, looking.azimuth, looking.elevation), positions, free);
    camera.scale *= static_cast<double>(size.y) / free.y;
    const double mm = render::mm_per_pixel(camera, size);
    const auto axes = render::axes_of(camera);
    const glm::dvec3 aside =
        mm * (0.5 * (looking.right - looking.left) * size.x * axes.right - 0.5 * (kScaleBar - kAround) * axes.up);
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

Result<render::Image> Artist::draw(const Panel& panel, const Plate& plate) {
    render::Frame frame = panel.frame;
    frame.overlays.caption.clear();
    RAMUS_TRY(image, draw(frame));
    if (panel.close_up) mark(image, frame, plate.panels[*panel.close_up].frame);
    if (!panel.inset) return std::move(image);
    RAMUS_TRY(inset, draw(*panel.inset));
    outline(inset, glm::ivec2(0), panel.inset->size, 2);
    mark(image, frame, *panel.inset);
    image.put(inset, frame.size - panel.inset->size - glm::ivec2(kInsetMargin));
    return std::move(image);
}

Result<render::Image> Artist::draw(const Plate& plate, Job& job) {
    constexpr int kHeading = 38; // pixels
    const bool headings =
        std::ranges::any_of(plate.panels, [](const Panel& panel) { return !panel.frame.overlays.caption.empty(); });
    const glm::ivec2 picture = plate.panels.front().frame.size, below(0, headings ? kHeading : 0);
    const glm::ivec2 size = picture + below;
    const auto columns = static_cast<int>(plate.columns);
    const auto count = static_cast<int>(plate.panels.size());
    const glm::ivec2 cells(std::min(columns, count), (count + columns - 1) / columns);
    const glm::ivec2 whole = cells * size + (cells - 1) * kGap;
    render::Image image(whole.x, whole.y);
    image.fill(glm::vec3(0.84F, 0.86F, 0.88F));
    for (int index = 0; index < count; ++index) {
        if (job.cancelled()) return fail("cancelled");
        const Panel& panel = plate.panels[static_cast<std::size_t>(index)];
        const glm::ivec2 at = glm::ivec2(index % columns, index / columns) * (size + kGap);
        RAMUS_TRY(drawn, draw(panel, plate));
        if (headings) image.put(heading(panel.frame.overlays.caption, {size.x, kHeading}), at);
        image.put(drawn, at + below);
        job.report(static_cast<float>(index + 1) / static_cast<float>(count));
    }
    return image;
}

} // namespace ramus::app::paper
