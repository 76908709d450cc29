// PlaneTables: what shade.frag needs of the frame's planes: their geometry as a uniform block, their pictures as layers
// of one texture. A picture is sent once, as long as its plane keeps it.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/renderer/view_setup.h"

#include <array>
#include <memory>

namespace ramus::render {

class PlaneTables {
public:
    void make();
    void release(); // releases everything but the block
    // Sends and binds everything. Fails if a picture is larger than the driver's textures. Throws OutOfGraphicsMemory.
    [[nodiscard]] Result<void> send(const Frame& frame, const ViewSetup& view);
    [[nodiscard]] std::size_t count() const { return count_; } // of the planes last sent, at most kMostPlanes

private:
    Buffer block_;
    Texture pictures_; // RGBA8, 4 bytes per pixel: premultiplied; a layer per plane
    std::size_t count_ = 0;
    glm::ivec3 size_{0};                                                // of pictures_
    std::array<std::shared_ptr<const LatePicture>, kMostPlanes> shown_; // in its layers
};

} // namespace ramus::render
