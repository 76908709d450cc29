// Reference: the centerlines and radii with which a surface is compared. They are those of the tree as it was read,
// with all branches, not smoothed and not pruned. The centerlines are sampled at places, a fraction of a radius apart.
// The reference also finds the vessels near a place. Lengths in mm, positions in RAS.
#pragma once

#include "core/base/halved_boxes.h"
#include "core/tree/contacts/links.h"
#include "core/tree/prepare.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace ramus::validate {

// A place on a centerline.
struct Place {
    int branch = 0;
    double along = 0.0; // mm from the branch's first point
    double step = 0.0;  // mm of centerline that this place represents
    glm::dvec3 at{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0}; // unit length
    double radius = 0.0;                 // interpolated linearly, mm
    // The unit of lengths along the vessel (mm): its radius, or nearly the radius of a wider place nearby. If radii
    // jump from point to point, the radius between the points is not known.
    double scale = 0.0;
    bool turns = false;  // the centerline turns by 35 degrees within 1.5 radii before and after
    bool bent = false;   // within 1.5 radii of a sharp bend, where sections are oblique
    double to_end = 0.0; // mm along the branch to its nearest free end; infinite if it has none
    // Closeness (core/tree/contacts/links.h) of the closest other vessel, at most kFar. A branch counts as another
    // vessel of itself where it comes back: where it would be farther than kFar if it were straight.
    double beside = 0.0;
};
inline constexpr double kFar = 1.45; // beyond this closeness a vessel does not change another one's surface
// Whether a place is away from joints, free ends, other vessels and sharp bends, so that a cross-section is that of the
// vessel.
[[nodiscard]] bool is_alone(const Place& place);
// Parts of a surface farther than this from all centerlines, in radii, belong to no vessel.
inline constexpr double kOwn = 1.5;

// Vessels to exclude from a search: two branches, and the part of branch `near_on` that is nearer along it than kFar to
// the place `along` mm from its first point.
struct ButFor {
    std::array<int, 2> branches{tree::kNoBranch, tree::kNoBranch};
    int near_on = tree::kNoBranch;
    double along = 0.0;
};

// Finds vessels near a place: a bounding-volume hierarchy over links.
class NearbyVessels {
public:
    explicit NearbyVessels(const tree::Links& links);

    // The vessel with the least closeness to `place` (a ball), if it is below `most`, which must be at most kOwn. The
    // search stops at the first vessel below `enough`.
    struct Nearest {
        double closeness = 0.0;
        int branch = tree::kNoBranch; // kNoBranch: none
        double radius = 0.0;          // of the vessel at its nearest place, mm
    };
    [[nodiscard]] Nearest nearest(const tree::Point& place, double most, const ButFor& but, double enough) const;

private:
    [[nodiscard]] bool is_out(const ButFor& but, std::uint32_t link, double share, double radii) const;

    const tree::Links& links_;
    HalvedBoxes boxes_;         // of links
    std::vector<double> along_; // by link: mm from its branch's first point
};

// Centerlines with their links and search structure. Not copyable, since the members refer to each other.
struct Axes {
    explicit Axes(tree::PreparedTree of) : prepared(std::move(of)), links(prepared), vessels(links) {}
    Axes(const Axes&) = delete;
    Axes& operator=(const Axes&) = delete;
    tree::PreparedTree prepared;
    tree::Links links;
    NearbyVessels vessels;
};

class Reference {
public:
    explicit Reference(const tree::VesselTree& source);

    // The edge of a voxel, mm, which limits the accuracy of the tree. 0: the points do not come from voxels.
    [[nodiscard]] double grain_mm() const { return grain_mm_; }
    [[nodiscard]] const Axes& axes() const { return axes_; }
    [[nodiscard]] const tree::VesselTree& tree() const { return axes_.prepared.tree; }
    [[nodiscard]] const NearbyVessels& vessels() const { return axes_.vessels; }
    [[nodiscard]] const std::vector<Place>& places() const { return places_; } // branch by branch, along each
    // The places of one branch.
    [[nodiscard]] std::span<const Place> places_of(std::size_t branch) const {
        return std::span(places_).subspan(first_[branch], first_[branch + 1] - first_[branch]);
    }
    [[nodiscard]] std::size_t first_of(std::size_t branch) const { return first_[branch]; }
    [[nodiscard]] std::size_t branches() const { return first_.size() - 1; }

private:
    double grain_mm_;
    Axes axes_;
    std::vector<Place> places_;
    std::vector<std::size_t> first_; // by branch: the index of its first place; and the end
};

} // namespace ramus::validate
