#include "render/renderer/renderer.h"

#include "render/renderer/renderer_impl.h"

#include <algorithm>
#include <string>

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

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(std::size_t glass_bytes, std::size_t surface_bytes) {
    auto impl = std::make_unique<Impl>(glass_bytes, surface_bytes);
    if (auto ready = impl->initialise(); !ready) return tl::unexpected(ready.error());
    return std::unique_ptr<Renderer>(new Renderer(std::move(impl)));
}

Result<DrawStatistics> Renderer::draw(const Frame& frame, std::size_t upload_budget, double seconds) {
    return impl_->draw(frame, upload_budget, seconds);
}
Refined Renderer::refine(double seconds) { return impl_->refine(seconds); }
std::size_t Renderer::surface_bytes() const { return impl_->surface_bytes(); }
unsigned Renderer::texture() const { return impl_->picture().colour; }
Image Renderer::read_image() { return impl_->picture().read(); }
void Renderer::present(unsigned framebuffer, int x, int y) { impl_->picture().present(framebuffer, x, y); }
BranchPicture Renderer::read_branches() { return impl_->read_branches(); }
Pick Renderer::pick(double x, double y) { return impl_->pick(x, y); }
void Renderer::request_pick(double x, double y) {
    try {
        impl_->request_pick(x, y);
    } catch (const OutOfGraphicsMemory&) {
        impl_->request_pick(-1e9, -1e9); // the answer is: nothing there
    }
}
std::optional<Pick> Renderer::poll_pick() { return impl_->poll_pick(); }

Target::Target(int width, int height) : picture_(std::make_unique<PictureTarget>()) { picture_->make({width, height}); }
Target::~Target() = default;
unsigned Target::framebuffer() const { return picture_->framebuffer; }
Image Target::read_image() const { return picture_->read_premultiplied(); }

} // namespace ramus::render
