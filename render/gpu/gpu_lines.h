// GpuLines: centerlines on the graphics card, sent once for each that comes. The passes read them as buffer textures:
// lines are drawn from them, and a point of the surface finds what its branch is like there. Lines are drawn with as
// many points as the view needs (render/scene/line_levels.h), in parts that a software rasteriser takes a few
// milliseconds for.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gpu/gpu_mesh.h"
#include "render/scene/bounds.h"
#include "render/scene/camera.h"
#include "render/scene/centerlines.h"
#include "render/scene/line_levels.h"

#include <array>
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
        [[nodiscard]] bool sent() const { return points_.buffer != 0; }

    private:
        friend GpuLines;
        std::vector<Centerlines::Run> runs_;
        BufferTexture points_;    // RGBA32F: position, mm from the root
        BufferTexture details_;   // RG32UI: bits of the diameter, branch
        BufferTexture run_table_; // RG32UI: first point, count
    };
    [[nodiscard]] const Copy& whole() const { return whole_; }
    // Binds one of the lines' lists of numbers in place of diameters: after whole().bind(), for what colours by it.
    void bind_list(std::uint32_t list);
    [[nodiscard]] const Copy& thinned(); // for what moves; made and sent when it is asked for first

    // Stretches of lines that are drawn together.
    class Stretches {
    public:
        [[nodiscard]] std::size_t parts() const { return parts_.size(); }
        [[nodiscard]] std::uint64_t segments() const { return segments_; }
        static constexpr std::uint32_t kMostInPart = std::uint32_t{1} << 14; // segments

    private:
        friend GpuLines;
        struct Part {
            int level;
            std::size_t begin; // in what follows
        };
        void add(int level, const Centerlines::Run& run);
        std::vector<GLint> firsts_; // of vertices
        std::vector<GLsizei> counts_;
        std::vector<Part> parts_;
        std::uint32_t end_ = 0, in_part_ = 0; // of the last stretch: its last point; segments of the last part
        std::uint64_t segments_ = 0;
    };
    // The lines in a picture of `size` of branches whose entry in `layers` is one of `drawn` (missing entries are
    // opaque).
    [[nodiscard]] Stretches stretches(const Camera& camera, glm::ivec2 size, const std::vector<Layer>& layers,
                                      std::initializer_list<Layer> drawn);
    void draw_part(const Stretches& stretches, std::size_t part) const; // six corners a segment, without attributes

private:
    [[nodiscard]] const Copy& level(int number) const {
        return number + 1 < kLineLevels ? levels_.at(static_cast<std::size_t>(number)) : whole_;
    }

    std::shared_ptr<const Centerlines> shown_;
    Box bounds_;
    std::vector<LineBall> balls_;
    double extent_mm_ = 0.0;
    Copy whole_, thinned_;
    BufferTexture list_;                       // RG32UI: bits of a number, branch
    std::uint32_t list_sent_ = 0;              // the list in it, where there is one
    std::array<Copy, kLineLevels - 1> levels_; // made and sent when they are first needed
};

// GpuSkeleton: centerlines with rings of the local radius on the graphics card, sent once for each that comes. Rings
// stand across the vessel, evenly along every branch, far enough apart not to crowd; which of them are large enough in
// a picture to be seen is found anew for each.

// A circle around a vessel.
struct SkeletonRing {
    glm::vec3 centre{0.0F}; // mm, relative to the lines' origin
    float radius_mm = 0.0F;
    glm::vec3 axis{0.0F, 0.0F, 1.0F}; // of unit length
    std::int32_t branch = -1;
};

// Evenly along each branch, at a distance of kRingSpacing of its mean radii or more; one in the middle of a branch that
// is shorter than that, none on one that is shorter than a radius. By branch, ascending.
inline constexpr double kRingSpacing = 2.0;
[[nodiscard]] std::vector<SkeletonRing> skeleton_rings(const Centerlines& lines);

class GpuSkeleton {
public:
    void follow(const std::shared_ptr<const Centerlines>& lines);
    [[nodiscard]] const Centerlines* shown() const { return lines_.shown(); } // null: nothing

    [[nodiscard]] GpuLines& lines() { return lines_; }
    [[nodiscard]] GLuint rings() const { return rings_.texture; } // RGBA32F: centre, radius; axis

    // The rings that can be seen, by how many corners they need: indices into rings().
    struct Seen {
        std::vector<std::uint32_t> small, large;
    };
    [[nodiscard]] Seen seen(const Camera& camera, glm::ivec2 size, const std::vector<Layer>& layers) const;

private:
    GpuLines lines_;
    std::vector<SkeletonRing> all_;
    BufferTexture rings_;
};

// Of a ring in a picture: below the least its radius in pixels is too small to be told from the line.
inline constexpr double kLeastRingPixels = 3.5, kLargeRingPixels = 16.0;
inline constexpr int kSmallRingSteps = 20, kLargeRingSteps = 72, kMovingRingSteps = 12;

} // namespace ramus::render
