// GpuLines: centerlines on the graphics card, sent once for each that comes. The passes read them as buffer textures:
// lines are drawn from them, and a place on the surface finds what its branch is like there.
#pragma once

#include "render/centerlines.h"
#include "render/gl_objects.h"
#include "render/gpu_mesh.h"

#include <memory>
#include <vector>

namespace ramus::render {

class GpuLines {
public:
    void follow(const std::shared_ptr<const Centerlines>& lines);
    [[nodiscard]] const Centerlines* shown() const { return shown_.get(); } // null: nothing
    [[nodiscard]] GLuint points() const { return points_texture_; }         // RGBA32F: position, mm from the root
    [[nodiscard]] GLuint details() const { return details_texture_; }       // RG32UI: bits of the diameter, branch
    [[nodiscard]] GLuint runs() const { return runs_texture_; }             // RG32UI: first point, count

    // By branch id: the branches that it meets, itself included, where glass meets what is opaque; none elsewhere.
    [[nodiscard]] std::vector<std::vector<int>> meetings(const std::vector<Layer>& layers) const;

    // Draws six corners a segment, without attributes, of branches that are glass.
    void draw(const std::vector<Layer>& layers) const;

private:
    std::shared_ptr<const Centerlines> shown_;
    std::vector<std::vector<int>> nodes_; // branches that meet at a place
    Buffer points_, details_, runs_;
    Texture points_texture_, details_texture_, runs_texture_;
};

// A buffer of `bytes` bytes that shaders read texel by texel.
void make_buffer_texture(Buffer& buffer, Texture& texture, GLenum format, const void* data, std::size_t bytes);

} // namespace ramus::render
