#include "render/renderer/renderer_impl.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::render {

Renderer::Impl::Window Renderer::Impl::pick_window(double x, double y) const {
    Window window;
    if (!last_ || !std::isfinite(x) || !std::isfinite(y)) return window;
    window.at = glm::dvec2(x, size_.y - y) * glm::dvec2(inner_) / glm::dvec2(size_);
    window.reach = kPickRadius * std::max(1.0, double(last_->pixel_ratio)) * inner_.y / size_.y + 0.5;
    const int radius = static_cast<int>(std::ceil(window.reach));
    const double px = std::floor(window.at.x), py = std::floor(window.at.y);
    if (px < -radius || py < -radius || px > inner_.x + radius || py > inner_.y + radius) return window;
    window.x = std::clamp(int(px) - radius, 0, inner_.x);
    window.y = std::clamp(int(py) - radius, 0, inner_.y);
    window.width = std::clamp(int(px) + radius + 1, 0, inner_.x) - window.x;
    window.height = std::clamp(int(py) + radius + 1, 0, inner_.y) - window.y;
    return window;
}

Pick Renderer::Impl::nearest_in(const Window& window, const std::uint32_t* ids, const float* depths,
                                const Camera& camera) const {
    Pick result;
    double nearest = window.reach * window.reach;
    for (int y = 0; y < window.height; ++y) {
        for (int x = 0; x < window.width; ++x) {
            const auto i = static_cast<std::size_t>(y * window.width + x);
            if (ids[i] == 0) continue;
            const glm::dvec2 pixel(window.x + x + 0.5, window.y + y + 0.5), away = pixel - window.at;
            const double squared = std::max(std::abs(away.x), std::abs(away.y)) <= 0.5 ? 0.0 : glm::dot(away, away);
            if (squared >= nearest) continue;
            nearest = squared;
            const glm::dvec2 in_picture = pixel * glm::dvec2(size_) / glm::dvec2(inner_);
            const int id = static_cast<int>(ids[i]) - 1;
            result.branch = id < kFirstSolid ? id : kNoBranch;
            result.lesion = id < kFirstSolid || id >= kFirstContext ? kNoLesion : id - kFirstSolid;
            result.position = unproject(camera, size_, {in_picture.x, size_.y - in_picture.y}, depths[i]);
        }
    }
    return result;
}

Pick Renderer::Impl::pick(double x, double y) {
    if (between_pictures()) finish();
    const Window window = pick_window(x, y);
    const std::size_t count = static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
    if (count == 0) return {};
    std::vector<std::uint32_t> ids(count);
    std::vector<float> depths(count);
    if (cast_) {
        for (int row = 0; row < window.height; ++row) {
            const std::ptrdiff_t from = std::ptrdiff_t{window.y + row} * caster_.stride() + window.x;
            const std::ptrdiff_t to = std::ptrdiff_t{row} * window.width;
            std::copy_n(caster_.ids() + from, window.width, ids.data() + to);
            std::copy_n(caster_.depths() + from, window.width, depths.data() + to);
        }
        return nearest_in(window, ids.data(), depths.data(), last_->camera);
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolve_target_);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadBuffer(GL_COLOR_ATTACHMENT0 + kTargetIdNormal);
    glReadPixels(window.x, window.y, window.width, window.height, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
    glReadBuffer(GL_COLOR_ATTACHMENT0 + kTargetPickedDepth);
    glReadPixels(window.x, window.y, window.width, window.height, GL_RED, GL_FLOAT, depths.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    return nearest_in(window, ids.data(), depths.data(), last_->camera);
}

BranchPicture Renderer::Impl::read_branches() {
    if (between_pictures()) finish();
    BranchPicture picture;
    if (!last_) return picture;
    if (cast_) {
        picture.width = size_.x;
        picture.height = size_.y;
        for (int y = size_.y - 1; y >= 0; --y) {
            const std::uint32_t* row = caster_.ids() + std::ptrdiff_t{y} * caster_.stride();
            for (int x = 0; x < size_.x; ++x)
                picture.branches.push_back((row[x] & record::kSolid) != 0 ? kNoBranch : static_cast<int>(row[x]) - 1);
        }
        return picture;
    }
    const auto inner_width = static_cast<std::size_t>(inner_.x), inner_height = static_cast<std::size_t>(inner_.y);
    std::vector<std::uint32_t> ids(inner_width * inner_height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolve_target_);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadBuffer(GL_COLOR_ATTACHMENT0 + kTargetIdNormal);
    glReadPixels(0, 0, inner_.x, inner_.y, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    picture.width = size_.x;
    picture.height = size_.y;
    const auto width = static_cast<std::size_t>(size_.x), height = static_cast<std::size_t>(size_.y);
    picture.branches.resize(width * height);
    for (std::size_t y = 0; y < height; ++y) {
        // GL counts from below; a picture that is drawn quickly has fewer pixels inside.
        const std::uint32_t* row = &ids[inner_width * ((height - 1 - y) * inner_height / height)];
        for (std::size_t x = 0; x < width; ++x) {
            const int id = static_cast<int>(row[x * inner_width / width]) - 1;
            picture.branches[y * width + x] = id < kFirstSolid ? id : kNoBranch;
        }
    }
    return picture;
}

void Renderer::Impl::request_pick(double x, double y) {
    pick_fence_.reset();
    pick_answer_.reset();
    if (between_pictures()) {
        pick_answer_ = Pick{};
        return;
    }
    if (cast_) {
        pick_answer_ = pick(x, y);
        return;
    }
    pick_window_ = pick_window(x, y);
    const auto bytes = static_cast<GLsizeiptr>(pick_window_.width) * pick_window_.height * 4;
    if (bytes > 0) {
        pick_camera_ = last_->camera;
        if (2 * bytes > pick_buffer_size_) {
            pick_buffer_size_ = 0; // until it is there
            pick_buffer_ =
                make_buffer(static_cast<std::size_t>(2 * bytes), nullptr, GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT);
            pick_buffer_size_ = 2 * bytes;
        }
        glBindFramebuffer(GL_READ_FRAMEBUFFER, resolve_target_);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, pick_buffer_);
        glPixelStorei(GL_PACK_ALIGNMENT, 4);
        glReadBuffer(GL_COLOR_ATTACHMENT0 + kTargetIdNormal);
        glReadPixels(pick_window_.x, pick_window_.y, pick_window_.width, pick_window_.height, GL_RED_INTEGER,
                     GL_UNSIGNED_INT, nullptr);
        glReadBuffer(GL_COLOR_ATTACHMENT0 + kTargetPickedDepth);
        glReadPixels(pick_window_.x, pick_window_.y, pick_window_.width, pick_window_.height, GL_RED, GL_FLOAT,
                     reinterpret_cast<void*>(static_cast<std::uintptr_t>(bytes)));
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    }
    pick_fence_.emplace().put();
}

std::optional<Pick> Renderer::Impl::poll_pick() {
    if (pick_answer_) return std::exchange(pick_answer_, std::nullopt);
    if (!pick_fence_ || !pick_fence_->passed(0.0)) return std::nullopt;
    pick_fence_.reset();
    const auto bytes = static_cast<GLsizeiptr>(pick_window_.width) * pick_window_.height * 4;
    // A picture of another size or view has come in between: the answer would be about the old one.
    if (bytes == 0 || !last_ || pick_window_.x + pick_window_.width > inner_.x ||
        pick_window_.y + pick_window_.height > inner_.y)
        return Pick{};
    const auto* data =
        static_cast<const std::byte*>(glMapNamedBufferRange(pick_buffer_, 0, 2 * bytes, GL_MAP_READ_BIT));
    if (data == nullptr) return Pick{};
    const Pick result = nearest_in(pick_window_, reinterpret_cast<const std::uint32_t*>(data),
                                   reinterpret_cast<const float*>(data + bytes), pick_camera_);
    glUnmapNamedBuffer(pick_buffer_);
    return result;
}

} // namespace ramus::render
