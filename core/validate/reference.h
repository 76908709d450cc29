// What a surface is held against: the centerlines and radii of a tree as it was read, with all branches, never as its
// surface smooths or prunes them. They are sampled at places, each of which stands for a fraction of a vessel's radius;
// and the reference knows which vessels are near a place. mm, RAS.
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
    double step = 0.0;  // mm of centerline that this place stands for
    glm::dvec3 at{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0}; // unit length
    double radius = 0.0;                 // between two points, linear
    // What lengths along the vessel are counted in: its radius, or nearly that of a wider place next to it. Where radii
    // jump from point to point, nobody knows what lies between. mm
    double scale = 0.0;
    bool turns = false; // by 35 degrees over one and a half radii to either side
    bool bent = false;  // no farther than one and a half radii from a sharp bend: no section is across the vessel there
    double to_end = 0.0; // mm along the branch to its nearest free end; infinite where it has none
    // Closeness (core/tree/contacts/links.h) of the closest other vessel, kFar at most. A branch is another vessel to
    // itself where it comes back: where it would be farther than kFar if it were straight.
    double beside = 0.0;
};
inline constexpr double kFar = 1.45; // beyond, a vessel changes nothing at another one's surface
// Away from joints, free ends, other vessels and sharp bends: a cross-section there is that of the vessel.
[[nodiscard]] bool is_alone(const Place& place);
// Parts of a surface farther than this from all centerlines, in radii, are of no vessel.
inline constexpr double kOwn = 1.5;

// What is left out where vessels are looked for.
struct ButFor {
    std::array<int, 2> branches{tree::kNoBranch, tree::kNoBranch};
    int near_on = tree::kNoBranch; // of this branch, what is nearer along it than kFar, seen from
    double along = 0.0;            // so many mm from its first point
};

// Vessels by place: a tree of boxes over links.
class NearbyVessels {
public:
    explicit NearbyVessels(const tree::Links& links);

    // The vessel to which the place, a ball of its radius, is closest; none that is not below `most`, kOwn at the most.
    // Anything below `enough` is taken.
    struct Nearest {
        double closeness = 0.0;
        int branch = tree::kNoBranch; // kNoBranch: none
        double radius = 0.0;          // of the vessel, there
    };
    [[nodiscard]] Nearest nearest(const tree::Point& place, double most, const ButFor& but, double enough) const;

private:
    [[nodiscard]] bool is_out(const ButFor& but, std::uint32_t link, double share, double radii) const;

    const tree::Links& links_;
    HalvedBoxes boxes_;         // of links
    std::vector<double> along_; // mm from its branch's first point to each link
};

// Centerlines as vessels. Parts refer to each other.
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

    // The edge of a voxel, mm: what is shorter, the tree does not know. 0: its points are no voxels.
    [[nodiscard]] double grain_mm() const { return grain_mm_; }
    [[nodiscard]] const Axes& axes() const { return axes_; }
    [[nodiscard]] const tree::VesselTree& tree() const { return axes_.prepared.tree; }
    [[nodiscard]] const NearbyVessels& vessels() const { return axes_.vessels; }
    [[nodiscard]] const std::vector<Place>& places() const { return places_; } // branch by branch, along each
    // Of one branch.
    [[nodiscard]] std::span<const Place> places_of(std::size_t branch) const {
        return std::span(places_).subspan(first_[branch], first_[branch + 1] - first_[branch]);
    }
    [[nodiscard]] std::size_t first_of(std::size_t branch) const { return first_[branch]; }
    [[nodiscard]] std::size_t branches() const { return first_.size() - 1; }

private:
    double grain_mm_;
    Axes axes_;
    std::vector<Place> places_;
    std::vector<std::size_t> first_; // of each branch, and one past the last
};

} // namespace ramus::validate
