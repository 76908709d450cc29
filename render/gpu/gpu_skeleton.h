// GpuSkeleton: centerlines with rings of the local radius on the graphics card, sent once for each that comes. Rings
// stand across the vessel, evenly along every branch, far enough apart not to crowd; which of them are large enough in
// a picture to be seen is found anew for each.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/scene/camera.h"
#include "render/scene/centerlines.h"
#include "render/scene/layer.h"

#include <memory>
#include <vector>

namespace ramus::render {

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
    [[nodiscard]] const Centerlines* shown() const { return shown_.get(); } // null: nothing

    // The lines as buffer textures; with fewer points while the view moves.
    struct Lines {
        std::vector<Centerlines::Run> runs; // by branch
        Buffer point_buffer, branch_buffer;
        Texture points;   // RGBA32F: position, radius in mm
        Texture branches; // R32UI, of the same points
        void send(const Centerlines& lines);
        // Draws six corners a segment, without attributes, of branches that are not in Layer::kNone.
        void draw(const std::vector<Layer>& layers) const;
    };
    [[nodiscard]] const Lines& lines(bool moving) const { return moving ? thinned_ : whole_; }
    [[nodiscard]] GLuint rings() const { return ring_texture_; } // RGBA32F: centre, radius; axis

    // The rings that can be seen, by how many corners they need: indices into rings().
    struct Seen {
        std::vector<std::uint32_t> small, large;
    };
    [[nodiscard]] Seen seen(const Camera& camera, glm::ivec2 size, const std::vector<Layer>& layers) const;

private:
    std::shared_ptr<const Centerlines> shown_;
    std::vector<SkeletonRing> all_;
    Lines whole_, thinned_;
    Buffer ring_buffer_;
    Texture ring_texture_;
};

// Of a ring in a picture: below the least its radius in pixels is too small to be told from the line.
inline constexpr double kLeastRingPixels = 3.5, kLargeRingPixels = 16.0;
inline constexpr int kSmallRingSteps = 20, kLargeRingSteps = 72, kMovingRingSteps = 12;

} // namespace ramus::render
