#include "render/renderer/passes/plane_tables.h"

#include "render/image/image.h"
#include "render/scene/seen_plane.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <string>
#include <vector>

namespace ramus::render {

namespace {

// Filtering needs premultiplied colours: pixels outside the scan must not darken those at its edge.
void send_layer(GLuint pictures, int layer, const Image& image) {
    std::vector<std::uint8_t> premultiplied;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
        if (image.rgba[i] == 255) continue;
        if (premultiplied.empty()) premultiplied = image.rgba;
        for (std::size_t c = i - 3; c < i; ++c)
            premultiplied[c] = static_cast<std::uint8_t>((image.rgba[c] * image.rgba[i] + 127) / 255);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage3D(pictures, 0, 0, 0, layer, image.width, image.height, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        premultiplied.empty() ? image.rgba.data() : premultiplied.data());
}

} // namespace

void PlaneTables::make() { block_ = make_buffer(sizeof(PlanesBlock), nullptr, GL_DYNAMIC_STORAGE_BIT); }

void PlaneTables::release() {
    Buffer block = std::move(block_);
    *this = {};
    block_ = std::move(block);
}

Result<void> PlaneTables::send(const Frame& frame, const ViewSetup& view) {
    const std::size_t count = std::min(frame.planes.size(), shown_.size());
    count_ = count;
    glm::ivec3 size(1, 1, int(count));
    for (std::size_t i = 0; i < count; ++i)
        if (const Image* image = picture_of(frame.planes[i]))
            size = glm::max(size, glm::ivec3(image->width, image->height, 1));
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(size.x, size.y) > largest)
        return fail("a slice of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                        " pixels is larger than this graphics driver's " + std::to_string(largest),
                    {}, "give slices of fewer pixels");
    if (glm::any(glm::greaterThan(size, size_))) {
        shown_ = {};
        size_ = glm::ivec3(0); // until it is there
        pictures_ = make_deep_texture(GL_TEXTURE_2D_ARRAY, GL_RGBA8, size.x, size.y, size.z);
        set_filter(pictures_, GL_LINEAR);
        size_ = size;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Image* image = picture_of(frame.planes[i]);
        if (image == nullptr || frame.planes[i].picture == shown_[i]) continue;
        send_layer(pictures_, static_cast<int>(i), *image);
        shown_[i] = frame.planes[i].picture;
    }
    const PlanesBlock block =
        planes_block(frame.planes, eye_matrix(frame.camera), view.block, view.pixels_a_point(frame));
    glNamedBufferSubData(block_, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockPlanes, block_);
    glBindTextureUnit(kUnitPlanes, pictures_);
    return {};
}

} // namespace ramus::render
