#include "render/renderer/picking.h"

#include "render/scene/record_flags.h"
#include "render/scene/seen_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::render {

namespace {

// Ids minus 1: lesions are above all branches, context above all lesions.
constexpr int kFirstLesion = int{record::kSolid}, kFirstContext = int{record::kSolid | record::kContext};

} // namespace

PickWindow pick_window(float pixel_ratio, const ViewSetup& view, double x, double y) {
    PickWindow window;
    if (!std::isfinite(x) || !std::isfinite(y)) return window;
    window.at = glm::dvec2(x, view.picture.y - y) * glm::dvec2(view.size) / glm::dvec2(view.picture);
    window.reach = kPickRadius * std::max(1.0, double(pixel_ratio)) * view.size.y / view.picture.y + 0.5;
    const int radius = static_cast<int>(std::ceil(window.reach));
    const double px = std::floor(window.at.x), py = std::floor(window.at.y);
    if (px < -radius || py < -radius || px > view.size.x + radius || py > view.size.y + radius) return window;
    window.x = std::clamp(int(px) - radius, 0, view.size.x);
    window.y = std::clamp(int(py) - radius, 0, view.size.y);
    window.width = std::clamp(int(px) + radius + 1, 0, view.size.x) - window.x;
    window.height = std::clamp(int(py) + radius + 1, 0, view.size.y) - window.y;
    return window;
}

Pick nearest_in(const PickWindow& window, const std::uint32_t* ids, const float* depths, const Camera& camera,
                const ViewSetup& view, const std::vector<ScanPlane>& planes) {
    const SeenPlanes seen(planes, camera, view.picture);
    const glm::dvec2 to_picture = glm::dvec2(view.picture) / glm::dvec2(view.size);
    const auto before = [&](const PlaneHit& plane, std::size_t i) { // a vessel that ends at the plane is before it
        return plane.plane != kNoPlane && (ids[i] == 0 || plane.depth_mm * (1.0 + 1e-5) < double(depths[i]));
    };
    Pick result;
    double nearest = window.reach * window.reach;
    for (int y = 0; y < window.height; ++y) {
        for (int x = 0; x < window.width; ++x) {
            const auto i = static_cast<std::size_t>(y * window.width + x);
            if (ids[i] == 0) continue;
            const glm::dvec2 pixel(window.x + x + 0.5, window.y + y + 0.5), away = pixel - window.at;
            const double squared = std::max(std::abs(away.x), std::abs(away.y)) <= 0.5 ? 0.0 : glm::dot(away, away);
            if (squared >= nearest) continue;
            const glm::dvec2 in_picture = pixel * to_picture;
            if (before(seen.at(in_picture), i)) continue;
            nearest = squared;
            const int id = static_cast<int>(ids[i]) - 1;
            result.branch = branch_of(ids[i]);
            result.lesion = id < kFirstLesion || id >= kFirstContext ? kNoLesion : id - kFirstLesion;
            result.position = unproject(camera, view.picture, {in_picture.x, view.picture.y - in_picture.y}, depths[i]);
        }
    }
    if (seen.empty() || result.branch != kNoBranch || result.lesion != kNoLesion) return result;
    const int x = static_cast<int>(std::floor(window.at.x)) - window.x;
    const int y = static_cast<int>(std::floor(window.at.y)) - window.y;
    if (x < 0 || y < 0 || x >= window.width || y >= window.height) return result;
    const glm::dvec2 at = window.at * to_picture;
    const PlaneHit plane = seen.at(at);
    if (!before(plane, static_cast<std::size_t>(y * window.width + x))) return result;
    result.plane = plane.plane;
    result.position = unproject(camera, view.picture, {at.x, view.picture.y - at.y}, plane.depth_mm);
    return result;
}

int branch_of(std::uint32_t id) {
    return static_cast<int>(id) - 1 < kFirstLesion ? static_cast<int>(id) - 1 : kNoBranch;
}

void read_pixels(const PickWindow& window, const ResolvedTarget& from, int target, void* to) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(target));
    const bool ids = target == kTargetIdNormal;
    glReadPixels(window.x, window.y, window.width, window.height, ids ? GL_RED_INTEGER : GL_RED,
                 ids ? GL_UNSIGNED_INT : GL_FLOAT, to);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

void PickRequest::drop() {
    fence_.reset();
    answer_.reset();
}

void PickRequest::answer(const Pick& pick) {
    drop();
    answer_ = pick;
}

void PickRequest::ask(const PickWindow& window, const Camera& camera, const std::vector<ScanPlane>& planes,
                      const ResolvedTarget& from) {
    drop();
    window_ = window;
    camera_ = camera;
    planes_ = planes;
    const std::size_t bytes = 4 * window.pixels();
    if (bytes > 0) {
        if (2 * bytes > capacity_) {
            capacity_ = 0; // until it is there
            buffer_ = make_buffer(2 * bytes, nullptr, GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT);
            capacity_ = 2 * bytes;
        }
        glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
        read_pixels(window, from, kTargetIdNormal, nullptr);
        read_pixels(window, from, kTargetPickedDepth, offset_pointer(bytes));
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    }
    fence_.emplace().put();
}

std::optional<Pick> PickRequest::poll(const ViewSetup& view) {
    if (answer_) return std::exchange(answer_, std::nullopt);
    if (!fence_ || !fence_->passed(0.0)) return std::nullopt;
    fence_.reset();
    const std::size_t bytes = 4 * window_.pixels();
    // The picture's size or view has changed since the request, so the answer would be wrong.
    if (bytes == 0 || window_.x + window_.width > view.size.x || window_.y + window_.height > view.size.y)
        return Pick{};
    const auto* data = static_cast<const std::byte*>(
        glMapNamedBufferRange(buffer_, 0, static_cast<GLsizeiptr>(2 * bytes), GL_MAP_READ_BIT));
    if (data == nullptr) return Pick{};
    const Pick result = nearest_in(window_, reinterpret_cast<const std::uint32_t*>(data),
                                   reinterpret_cast<const float*>(data + bytes), camera_, view, planes_);
    glUnmapNamedBuffer(buffer_);
    return result;
}

} // namespace ramus::render
