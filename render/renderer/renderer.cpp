// Picks and read-backs of the picture.
#include "render/renderer/renderer.h"

#include "render/gl/within_memory.h"

#include <algorithm>
#include <string>
#include <utility>

namespace ramus::render {

Result<void> check_size(std::int64_t width, std::int64_t height) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1)
        return fail("a picture of " + size + " pixels has no pixels", {}, "give a size such as 1600x1200");
    if (width > kLargestSide || height > kLargestSide || width * height > kLargestArea)
        return fail("a picture of " + size + " pixels is too large", {},
                    "at most " + std::to_string(kLargestSide) + " pixels a side and " +
                        std::to_string(kLargestArea / 1000000) + " million in all");
    return {};
}

Result<std::unique_ptr<Renderer>> Renderer::create(std::size_t glass_bytes, std::size_t surface_bytes) {
    const auto make = [&]() -> Result<std::unique_ptr<Renderer>> {
        auto renderer = create_later(glass_bytes, surface_bytes);
        if (auto ready = renderer->card_.passes.make(Passes::For::kAll); !ready) return tl::unexpected(ready.error());
        return renderer;
    };
    return within_memory(
        "close other programs that draw", [] {}, make);
}

std::unique_ptr<Renderer> Renderer::create_later(std::size_t glass_bytes, std::size_t surface_bytes) {
    return std::unique_ptr<Renderer>(new Renderer(glass_bytes, surface_bytes));
}

Pick Renderer::pick(double x, double y) {
    if (!state_.answers()) finish();
    if (!last_ || !state_.answers()) return {};
    const PickSource shown{number_, shown_view_, last_->camera, last_->pixel_ratio, last_->planes};
    return state_.by_caster() ? pick_in_cast(shown, x, y) : pick_in(shown, card_.targets.resolved, x, y);
}

std::optional<Pick> Renderer::pick(double x, double y, int of, glm::ivec2 size) {
    if (of > 0 && of == in_kept_.number) return pick_in(in_kept_, kept_.resolved, x, y);
    if (of > 0 && of == in_targets_.number) return pick_in(in_targets_, card_.targets.resolved, x, y);
    if (of > 0 && of == in_cast_.number) return pick_in_cast(in_cast_, x, y);
    if (last_ && last_->size != size) return {};
    return pick(x, y);
}

Pick Renderer::pick_in(const PickSource& source, const ResolvedTarget& from, double x, double y) {
    const PickWindow window = pick_window(source.pixel_ratio, source.view, x, y);
    if (window.pixels() == 0) return {};
    std::vector<std::uint32_t> ids(window.pixels());
    std::vector<float> depths(window.pixels());
    read_pixels(window, from, kTargetIdNormal, ids.data());
    read_pixels(window, from, kTargetPickedDepth, depths.data());
    return nearest_in(window, ids.data(), depths.data(), source.camera, source.view, source.planes);
}

Pick Renderer::pick_in_cast(const PickSource& source, double x, double y) const {
    const PickWindow window = pick_window(source.pixel_ratio, source.view, x, y);
    if (window.pixels() == 0) return {};
    std::vector<std::uint32_t> ids(window.pixels());
    std::vector<float> depths(window.pixels());
    const caster::Caster& caster = card_.passes.cast.caster();
    for (int row = 0; row < window.height; ++row) {
        const std::ptrdiff_t from = std::ptrdiff_t{window.y + row} * caster.stride() + window.x;
        const std::ptrdiff_t to = std::ptrdiff_t{row} * window.width;
        std::copy_n(caster.ids() + from, window.width, ids.data() + to);
        std::copy_n(caster.depths() + from, window.width, depths.data() + to);
    }
    return nearest_in(window, ids.data(), depths.data(), source.camera, source.view, source.planes);
}

Renderer::PickSource Renderer::next_pick_source(const Frame& frame, const ViewSetup& view) {
    return {++number_, view, frame.camera, frame.pixel_ratio, frame.planes};
}

// Call before drawing another picture into the targets. Contents of an interrupted picture are not kept.
void Renderer::keep_pick_source() {
    if (in_targets_.number == 0) return;
    card_.targets.keep_resolved(kept_);
    in_kept_ = std::exchange(in_targets_, {});
}

BranchPicture Renderer::read_branches() {
    if (!state_.answers()) finish();
    BranchPicture picture;
    if (!last_ || !state_.answers()) return picture;
    const ViewSetup& view = shown_view_;
    const glm::ivec2 drawn = view.size;
    const bool by_caster = state_.by_caster();
    std::vector<std::uint32_t> read;
    if (!by_caster) {
        const PickWindow all{{}, 0.0, 0, 0, drawn.x, drawn.y};
        read.resize(all.pixels());
        read_pixels(all, card_.targets.resolved, kTargetIdNormal, read.data());
    }
    const std::uint32_t* ids = by_caster ? card_.passes.cast.caster().ids() : read.data();
    const std::ptrdiff_t stride = by_caster ? card_.passes.cast.caster().stride() : drawn.x;
    picture.width = view.picture.x;
    picture.height = view.picture.y;
    picture.branches.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    for (std::int64_t y = 0; y < picture.height; ++y) {
        // GL counts from below; an interactive picture has fewer pixels.
        const std::uint32_t* row = ids + stride * ((picture.height - 1 - y) * drawn.y / picture.height);
        for (std::int64_t x = 0; x < picture.width; ++x)
            picture.branches.push_back(branch_of(row[x * drawn.x / picture.width]));
    }
    return picture;
}

void Renderer::request_pick(double x, double y) {
    request_.drop();
    if (!state_.answers()) return request_.answer({});
    if (state_.by_caster()) return request_.answer(pick(x, y));
    try {
        request_.ask(pick_window(last_->pixel_ratio, shown_view_, x, y), last_->camera, last_->planes,
                     card_.targets.resolved);
    } catch (const OutOfGraphicsMemory&) {
        request_.answer({}); // nothing there
    }
}

bool Renderer::request_depths() {
    depths_.drop();
    if (!last_ || !state_.answers()) return false;
    const ViewSetup& view = shown_view_;
    try {
        if (state_.by_caster()) {
            const caster::Caster& caster = card_.passes.cast.caster();
            depths_.answer(depth_map_of(*last_, caster.depths(), view.size, caster.stride()));
        } else {
            depths_.ask(*last_, view, card_.targets.resolved);
        }
    } catch (const OutOfGraphicsMemory&) {
        return false;
    }
    return true;
}

std::optional<DepthMap> Renderer::read_depths() {
    if (!state_.answers()) finish();
    return request_depths() ? depths_.poll(kUntilDone) : std::nullopt;
}

std::optional<Pick> Renderer::poll_pick() {
    const auto found = request_.poll(shown_view_);
    return found && !last_ ? Pick{} : found;
}

} // namespace ramus::render
