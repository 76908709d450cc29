// GpuLines: centerlines on the graphics card, sent once per Centerlines value. Passes read them as buffer textures: to
// draw lines, and to look up properties of a branch at a surface point. Lines are drawn with as many points as the view
// needs (render/scene/line_levels.h), in parts that take a software rasteriser a few milliseconds.
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
    [[nodiscard]] const Box& bounds() const { return bounds_; }             // of the vessels around the lines

    class Copy {
    public:
        void send(const Centerlines& lines);
        void bind() const; // to the texture units of lines
        // Draws six vertices per segment, without attributes, for the branches whose entry in `layers` is in `drawn`
        // (branches without an entry are opaque). Needs bind(). Returns the number of segments.
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
    // Binds the given list of Centerlines::lists in place of diameters, for colouring by it. Call after whole().bind().
    void bind_list(std::uint32_t list);
    [[nodiscard]] const Copy& thinned(); // for moving views; built and sent on first use

    // Ranges of lines that are drawn together.
    class Stretches {
    public:
        [[nodiscard]] std::size_t parts() const { return parts_.size(); }
        [[nodiscard]] std::uint64_t segments() const { return segments_; }
        static constexpr std::uint32_t kMostInPart = std::uint32_t{1} << 14; // segments

    private:
        friend GpuLines;
        struct Part {
            int level;
            std::size_t begin; // index into firsts_, counts_
        };
        void add(int level, const Centerlines::Run& run);
        std::vector<GLint> firsts_; // in vertices
        std::vector<GLsizei> counts_;
        std::vector<Part> parts_;
        std::uint32_t end_ = 0, in_part_ = 0; // last point of the last range; segments in the last part
        std::uint64_t segments_ = 0;
    };
    // The ranges visible in a picture of `size` pixels, for the branches whose entry in `layers` is in `drawn`
    // (branches without an entry are opaque).
    [[nodiscard]] Stretches stretches(const Camera& camera, glm::ivec2 size, const std::vector<Layer>& layers,
                                      std::initializer_list<Layer> drawn);
    void draw_part(const Stretches& stretches, std::size_t part) const; // six vertices per segment, without attributes

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
    std::uint32_t list_sent_ = 0;              // the list in it, if any
    std::array<Copy, kLineLevels - 1> levels_; // built and sent on first use
};

// GpuSkeleton: centerlines with rings of the local radius on the graphics card, sent once per Centerlines value. Rings
// are perpendicular to the vessel and spaced evenly along every branch, without crowding. Each picture draws those that
// are large enough to be seen.

// A circle around a vessel.
struct SkeletonRing {
    glm::vec3 centre{0.0F}; // mm, relative to the lines' origin
    float radius_mm = 0.0F;
    glm::vec3 axis{0.0F, 0.0F, 1.0F}; // of unit length
    std::int32_t branch = -1;
};

// The rings of all branches, by ascending branch. Spacing is at least kRingSpacing times the branch's mean radius. A
// shorter branch has one ring in its middle; a branch shorter than a radius has none.
inline constexpr double kRingSpacing = 2.0;
[[nodiscard]] std::vector<SkeletonRing> skeleton_rings(const Centerlines& lines);

class GpuSkeleton {
public:
    void follow(const std::shared_ptr<const Centerlines>& lines);
    [[nodiscard]] const Centerlines* shown() const { return lines_.shown(); } // null: nothing

    [[nodiscard]] GpuLines& lines() { return lines_; }
    [[nodiscard]] GLuint rings() const { return rings_.texture; } // RGBA32F: centre, radius; axis

    // Visible rings by the number of steps they need: indices into rings().
    struct Seen {
        std::vector<std::uint32_t> small, large;
    };
    [[nodiscard]] Seen seen(const Camera& camera, glm::ivec2 size, const std::vector<Layer>& layers) const;

private:
    GpuLines lines_;
    std::vector<SkeletonRing> all_;
    BufferTexture rings_;
};

// Ring radii in pixels: a smaller ring than the first is indistinguishable from the line; from the second on, a ring
// needs more steps.
inline constexpr double kLeastRingPixels = 3.5, kLargeRingPixels = 16.0;
inline constexpr int kSmallRingSteps = 20, kLargeRingSteps = 72, kMovingRingSteps = 12;

} // namespace ramus::render
