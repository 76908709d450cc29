// GpuLines: centerlines on the graphics card, sent once for each that comes. The passes read them as buffer textures:
// lines are drawn from them, and a point of the surface finds what its branch is like there.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gpu/gpu_mesh.h"
#include "render/scene/bounds.h"
#include "render/scene/centerlines.h"

#include <functional>
#include <memory>
#include <vector>

namespace ramus::render {

class GpuLines {
public:
    void follow(const std::shared_ptr<const Centerlines>& lines);
    [[nodiscard]] const Centerlines* shown() const { return shown_.get(); } // null: nothing
    [[nodiscard]] const Box& bounds() const { return bounds_; }             // around the vessels that they run in

    // As buffer textures.
    struct Textures {
        GLuint points;  // RGBA32F: position, mm from the root
        GLuint details; // RG32UI: bits of the diameter, branch
        GLuint runs;    // RG32UI: first point, count
    };
    [[nodiscard]] Textures textures() const { return whole_.textures(); }
    void thin(); // makes and sends what thinned() and draw_thinned() are about, unless it is there
    [[nodiscard]] Textures thinned() const { return thinned_.textures(); } // for what moves

    // Draws six corners a segment, without attributes, of branches whose entry in `layers` is `layer` (missing entries
    // are opaque). Returns the number of segments.
    std::uint64_t draw(const std::vector<Layer>& layers, Layer layer) const;
    std::uint64_t draw_thinned(const std::vector<Layer>& layers, Layer layer) const;

private:
    struct Copy {
        std::vector<Centerlines::Run> runs;
        Buffer point_buffer, detail_buffer, run_buffer;
        Texture point_texture, detail_texture, run_texture;

        void send(const Centerlines& lines);
        [[nodiscard]] Textures textures() const { return {point_texture, detail_texture, run_texture}; }
        std::uint64_t draw(const std::vector<Layer>& layers, Layer layer) const;
    };
    std::shared_ptr<const Centerlines> shown_;
    Box bounds_;
    Copy whole_, thinned_;
    bool thinned_there_ = false;
};

// Six corners a segment, without attributes, of the branches that are `drawn`. Returns the number of segments.
std::uint64_t draw_runs(const std::vector<Centerlines::Run>& runs, const std::function<bool(std::size_t)>& drawn);

} // namespace ramus::render
