// GpuLines: centerlines on the graphics card, sent once for each that comes. The passes read them as buffer textures:
// lines are drawn from them, and a point of the surface finds what its branch is like there.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gpu/gpu_mesh.h"
#include "render/scene/bounds.h"
#include "render/scene/centerlines.h"

#include <initializer_list>
#include <memory>
#include <vector>

namespace ramus::render {

class GpuLines {
public:
    void follow(const std::shared_ptr<const Centerlines>& lines);
    [[nodiscard]] const Centerlines* shown() const { return shown_.get(); } // null: nothing
    [[nodiscard]] const Box& bounds() const { return bounds_; }             // around the vessels that they run in

    class Copy {
    public:
        void send(const Centerlines& lines);
        void bind() const; // to the units of lines
        // Draws six corners a segment, without attributes, of branches whose entry in `layers` is one of `drawn`
        // (missing entries are opaque); bound. Returns the number of segments.
        [[nodiscard]] std::uint64_t draw(const std::vector<Layer>& layers, std::initializer_list<Layer> drawn) const;

    private:
        std::vector<Centerlines::Run> runs_;
        BufferTexture points_;    // RGBA32F: position, mm from the root
        BufferTexture details_;   // RG32UI: bits of the diameter, branch
        BufferTexture run_table_; // RG32UI: first point, count
    };
    [[nodiscard]] const Copy& whole() const { return whole_; }
    [[nodiscard]] const Copy& thinned(); // for what moves; made and sent when it is asked for first

private:
    std::shared_ptr<const Centerlines> shown_;
    Box bounds_;
    Copy whole_, thinned_;
    bool thinned_there_ = false;
};

} // namespace ramus::render
