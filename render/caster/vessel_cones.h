// Round cones of vessels: from centerlines, once for a tree, and before the eye, for every picture.
#pragma once

#include "render/caster/cast_types.h"
#include "render/scene/centerlines.h"
#include "render/scene/frame.h"
#include "render/scene/layer.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <span>
#include <vector>

namespace ramus::render::caster {

// What is cast in a picture.
struct ConeList {
    enum class Kind : std::uint8_t { kNone, kOpaque, kGlass }; // kNone: there is nothing of it to see

    std::vector<RoundCone> cones;
    std::vector<Kind> kinds; // of them
};

// Appends balls of lesions, as glass: centre in eye space, radius.
void append_lesions(const View& view, const std::vector<glm::vec4>& spheres, ConeList& list);

// Which segments of a tree add to the field on each other's surface: found along the tree, once for all pictures.

// By point: the first one at the same position. Only ends of branches can share one.
[[nodiscard]] std::vector<std::uint32_t> coincident_points(const Centerlines& lines);

// Of segment s: segments[first[s]] to segments[first[s + 1] - 1], itself first; an even number, made so by one that
// there is not (their count).
struct Neighbours {
    std::vector<std::uint32_t> first, segments;
};

// `coincident`: coincident_points() of the lines. `points`: the first point of each segment, which ends at the next
// one. Segments are joined where they have a point in common and where their points coincide. `support_radii`: how far
// a segment's kernel reaches, in radii. Vessels that pass close by without being joined there are not found.
[[nodiscard]] Neighbours find_neighbours(const Centerlines& lines, std::span<const std::uint32_t> coincident,
                                         std::span<const std::uint32_t> points, float support_radii);

class VesselCones {
public:
    // Of the lines as they are; those of one object are the same for good. `as_field`: the surface is that of a field
    // around them, not round cones.
    void follow(const std::shared_ptr<const Centerlines>& lines, bool as_field);

    // Fills the list with cones for opaque vessels, for glass and for the lines inside it. `layers`: of branches;
    // `to_eye`: from mm to eye space. Returns how many vessels' cones can be seen. field() is of the same picture.
    std::size_t prepare(const Frame& frame, const View& view, const glm::dmat4& to_eye,
                        const std::vector<Layer>& layers, ConeList& list);
    [[nodiscard]] const Field& field() const { return field_; }

private:
    struct Segment {
        std::uint32_t point; // and the next one
        std::int32_t branch;
        // Points that the vessel comes from and goes on to; or one of these.
        static constexpr std::uint32_t kFree = ~0U, kJoins = ~0U - 1; // ends here; goes into another vessel here
        std::uint32_t previous, next;
    };
    // Where a picture has the segments.
    struct Placement {
        const Frame& frame;
        const View& view;
        glm::mat4 to_eye;
    };
    // What lasts from picture to picture: of the lines, of the surface's width, of what is in glass.
    void find_joints();
    void follow_width(const Frame& frame);
    void fit_cones(float width, float beyond_ends);
    void fit_to_field();
    void find_mixed_layers(const std::vector<Layer>& layers);
    // For every picture. False: there is nothing of it to see. The ends are those of `points` that the segment joins.
    [[nodiscard]] bool prepare(const Segment& segment, const Placement& placement, const std::vector<glm::vec4>& points,
                               RoundCone& cone) const;
    [[nodiscard]] bool prepare_line(const Segment& segment, const Placement& placement, RoundCone& cone) const;
    [[nodiscard]] FieldSegment field_segment_of(const Segment& segment, const glm::mat4& to_eye) const;

    std::shared_ptr<const Centerlines> lines_;
    bool as_field_ = false;
    Centerlines thinned_;
    std::vector<std::uint32_t> coincident_; // of its points: coincident_points()
    // By point of those: the ball around it that is nearest to the surface; and where the point itself is.
    std::vector<glm::vec4> fitted_, on_line_;
    // By segment; those that the field reads have one more, which is nowhere.
    std::vector<Segment> segments_;
    std::vector<std::uint32_t> segment_branches_;
    Neighbours neighbours_;
    float neighbours_width_ = 0.0F;                   // of the kernel that those are for; 0: of none
    float fitted_width_ = -1.0F, fitted_ends_ = 0.0F; // of the frame that all that is for
    std::vector<Layer> layers_, segment_layers_;      // by branch; by segment
    Neighbours other_layer_;                          // of the neighbours those of another layer
    std::vector<FieldSegment> field_segments_;        // none: the surface is cones
    Field field_{};
};

} // namespace ramus::render::caster
