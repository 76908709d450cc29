#include "render/renderer/depth_request.h"

#include "render/scene/seen_plane.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ramus::render {

namespace {

DepthMap empty_map_of(const Frame& frame) {
    DepthMap map;
    map.camera = frame.camera;
    map.picture = frame.size;
    map.size = DepthMap::size_for(frame.size);
    map.depths.assign(static_cast<std::size_t>(map.size.x) * static_cast<std::size_t>(map.size.y), DepthMap::kEmpty);
    return map;
}

} // namespace

DepthMap depth_map_of(const Frame& frame, const float* depths, glm::ivec2 size, std::ptrdiff_t stride) {
    DepthMap map = empty_map_of(frame);
    float* to = map.depths.data();
    for (int y = 0; y < map.size.y; ++y) {
        const float* row = depths + stride * ((2 * y + 1) * size.y / (2 * map.size.y));
        for (int x = 0; x < map.size.x; ++x) *to++ = row[(2 * x + 1) * size.x / (2 * map.size.x)];
    }
    add_planes(frame.planes, map);
    return map;
}

// The card subsamples: only the map's entries are transferred.
void DepthRequest::ask(const Frame& frame, const ViewSetup& view, const ResolvedTarget& from) {
    drop();
    DepthMap map = empty_map_of(frame);
    const auto bytes = static_cast<GLsizeiptr>(map.depths.size() * sizeof(float));
    if (made_for_ != map.size) {
        made_for_ = glm::ivec2(0); // until it is there
        texture_ = make_texture(GL_R32F, map.size.x, map.size.y);
        framebuffer_ = make_framebuffer({texture_});
        buffer_ = make_buffer(static_cast<std::size_t>(bytes), nullptr, GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT);
        made_for_ = map.size;
    }
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(kTargetPickedDepth));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
    glBlitFramebuffer(0, 0, view.size.x, view.size.y, 0, 0, map.size.x, map.size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, map.size.x, map.size.y, GL_RED, GL_FLOAT, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    fence_.emplace().put();
    wanted_ = std::move(map);
    planes_ = frame.planes;
}

void DepthRequest::answer(DepthMap map) {
    fence_.reset();
    wanted_ = std::move(map);
}

std::optional<DepthMap> DepthRequest::poll(double seconds) {
    if (!wanted_ || (fence_ && !fence_->passed(seconds))) return {};
    auto map = std::exchange(wanted_, std::nullopt);
    if (!std::exchange(fence_, std::nullopt)) return map;
    const auto bytes = static_cast<GLsizeiptr>(map->depths.size() * sizeof(float));
    const auto* data = static_cast<const float*>(glMapNamedBufferRange(buffer_, 0, bytes, GL_MAP_READ_BIT));
    if (data == nullptr) return map; // an empty one
    std::copy_n(data, map->depths.size(), map->depths.begin());
    glUnmapNamedBuffer(buffer_);
    add_planes(planes_, *map);
    return map;
}

} // namespace ramus::render
