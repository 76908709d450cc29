// What a surface is held against: the centerlines of a tree, smoothed as for its surface but with all branches, sampled
// at places of which each stands for a fraction of a vessel's radius; and which vessels are near a place. mm, RAS.
#pragma once

#include "core/tree/contacts/links.h"
#include "core/tree/prepare.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::validate {

// A place on a centerline.
struct Place {
    int branch = 0;
    double along = 0.0; // mm from the branch's first point
    double step = 0.0;  // mm of centerline that this place stands for
    glm::dvec3 at{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0}; // unit length
    double radius = 0.0;                 // as smoothed
    glm::dvec3 input_at{0.0};            // as it was read
    double input_radius = 0.0;           // likewise
    double to_end = 0.0;                 // mm along the branch to its nearest free end; infinite where it has none
    // Closeness (core/tree/contacts/links.h) of the closest other vessel, kFar at most. A branch is another vessel to
    // itself where it comes back: where it would be farther than kFar if it were straight.
    double beside = 0.0;
};
inline constexpr double kFar = 1.45; // beyond, a vessel changes nothing at another one's surface
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
    struct Node {
        glm::dvec3 least{0.0}, most{0.0};
        std::uint32_t first = 0; // a leaf: its first link; else its second child, the first one follows it
        std::uint32_t count = 0; // of links; 0: not a leaf
    };
    [[nodiscard]] bool is_out(const ButFor& but, std::uint32_t link, double share, double radii) const;

    const tree::Links& links_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_; // of links, in the order of the leaves
    std::vector<double> along_;        // mm from its branch's first point to each link
};

class Reference {
public:
    Reference(const tree::VesselTree& source, int smooth_passes);
    Reference(const Reference&) = delete; // parts refer to each other
    Reference& operator=(const Reference&) = delete;

    [[nodiscard]] int smooth_passes() const { return smooth_passes_; }
    [[nodiscard]] const tree::PreparedTree& prepared() const { return prepared_; }
    [[nodiscard]] const tree::Links& links() const { return links_; }
    [[nodiscard]] const NearbyVessels& vessels() const { return vessels_; }
    // The vessels as they were read: whoever made the surface may have smoothed them in another way, or not at all.
    [[nodiscard]] const NearbyVessels& input_vessels() const { return input_vessels_; }
    [[nodiscard]] const std::vector<Place>& places() const { return places_; } // branch by branch, along each
    // Of one branch.
    [[nodiscard]] std::span<const Place> places_of(std::size_t branch) const {
        return std::span(places_).subspan(first_[branch], first_[branch + 1] - first_[branch]);
    }
    [[nodiscard]] std::size_t first_of(std::size_t branch) const { return first_[branch]; }
    [[nodiscard]] std::size_t branches() const { return first_.size() - 1; }

private:
    int smooth_passes_;
    tree::PreparedTree prepared_;
    tree::Links links_;
    NearbyVessels vessels_;
    tree::Links input_links_;
    NearbyVessels input_vessels_;
    std::vector<Place> places_;
    std::vector<std::size_t> first_; // of each branch, and one past the last
};

} // namespace ramus::validate
