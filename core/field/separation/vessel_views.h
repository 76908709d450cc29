// VesselViews: evaluates one point near contacts: which vessels reach the point, the view of each vessel, and which
// vessel owns the point (vessel_field.h defines views, claims and owners).
//
// Order of calls: enter() for each brick, look() for each point, then queries about the point. Results are cached until
// the next look(). A "place" is the index of a segment in the brick's list. Positions are in mm, in the coordinates of
// the tree. Bricks that share a point agree on its value, and on its owner if both find one.
#pragma once

#include "core/field/kernel.h"
#include "core/field/separation/axes.h"
#include "core/field/separation/contact_zone.h"
#include "core/field/separation/local_contacts.h"
#include "core/tree/contacts/contacts.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace ramus::field {

// The field at a point, as one vessel sees it.
struct VesselView {
    std::uint32_t place = 0; // the vessel's segment that is nearest to the point, in radii
    double value = 0.0;
    glm::dvec3 gradient{0.0};
};

class VesselViews {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    // `segments`: all segments of the field.
    VesselViews(const Kernel& kernel, const FieldSegment* segments, const Pieces& pieces);

    // Begins a brick. Returns whether vessels are kept apart there or nearby; if not, no other function may be called.
    bool enter(SegmentIndices list, const GridAxes& axes);
    // Whether the point is in the ContactZone of the brick. Elsewhere the sight is plain, and no edge of the grid
    // connects two vessels that are kept apart.
    [[nodiscard]] bool in_zone(const glm::dvec3& point) const { return zone_.has(point); }
    [[nodiscard]] const LocalContacts& contacts() const { return contacts_; }
    [[nodiscard]] SegmentIndices list() const { return list_; }
    [[nodiscard]] float isovalue() const { return static_cast<float>(kernel_.isovalue); }
    // The measure of distance that a field value stands for (LongVessel), and the measure on the surface.
    [[nodiscard]] LongVessel::Place place_of(double value) const { return kernel_.long_vessel->place(kernel_, value); }
    [[nodiscard]] double surface_measure() const { return surface_measure_; }

    // kPlain: the field is the plain sum. kCut: the same, but the point is in a shadow and so outside of the vessel.
    // kParted: some vessel's view leaves out parts of the sum.
    enum class Sight : std::uint8_t { kPlain, kCut, kParted };
    // Sets the current point (mm). Keeps all cached results if the point is unchanged.
    void look(const glm::dvec3& point);
    [[nodiscard]] Sight sight();
    [[nodiscard]] const glm::dvec3& point() const { return point_; }
    // The segments that reach the point, ascending; whether none of them has a piece with partners; and the segment
    // nearest in radii, or kNone.
    [[nodiscard]] std::span<const std::uint32_t> seen() const { return feet_.near.all(); }
    [[nodiscard]] bool alone() const { return feet_.marked.count == 0; }
    [[nodiscard]] std::uint32_t nearest() const { return seen().empty() ? kNone : feet_.near.nearest; }
    // Whether the point is within claim_radii of a segment's axis.
    [[nodiscard]] bool may_claim(std::uint32_t place) const {
        return feet_.of(place, kFootRelative2) <= claim_radii2();
    }
    // After a plain sight(): whether the edge of a shadow is near the point.
    [[nodiscard]] bool beside_contact() const { return beside_contact_; }

    // A quick test, given the plain sum at the point. If true, the nearest vessel owns the point: the vessels that it
    // is kept apart from are too far away to claim the point, their terms are too small to matter, and no shadow covers
    // the point. False decides nothing.
    [[nodiscard]] bool is_undisputed(float plain);

    // Of a segment: the distance of the point from its axis (mm), the radius at the foot (mm), and the foot (mm).
    [[nodiscard]] double distance(std::uint32_t place) const;
    [[nodiscard]] double radius(std::uint32_t place) const { return feet_.of(place, kFootRadius); }
    [[nodiscard]] double tree_radius(std::uint32_t place) const; // of the tree at the foot, not of the kernel
    [[nodiscard]] glm::dvec3 foot(std::uint32_t place) const { return feet_.foot(place); }
    [[nodiscard]] std::int32_t branch(std::uint32_t place) const { return segments_[list_[place]].branch; }
    [[nodiscard]] bool apart(std::uint32_t a, std::uint32_t b) const { return contacts_.apart(piece(a), piece(b)); }

    // Evaluates the kernels of all segments of the list at the point, once for each point. Returns the number of
    // kernels evaluated. term(), view(), value(), judge() and is_within_another() need the terms.
    [[nodiscard]] std::uint64_t add_terms();
    [[nodiscard]] double term(std::uint32_t place) const {
        return static_cast<double>(terms_.row(SegmentTerms::kValue)[place]);
    }
    // The share of each segment's term, 0 to 1, that the view of segment `own` leaves out, by place.
    [[nodiscard]] std::span<const double> left_out(std::uint32_t own) { return left_out(vessel(own)); }
    [[nodiscard]] VesselView view(std::uint32_t own);
    [[nodiscard]] double value(std::uint32_t own); // of the view

    // The vector (mm) to the point from the nearest point of the vessel's axis. Where walls are drawn the moved axis
    // counts.
    [[nodiscard]] glm::dvec3 way_from(std::uint32_t own) { return point_ - way_out(vessel(own)).foot; }
    // The nearest shadow on a vessel, if it is nearer than `below` mm (nearest_shadow() in axes.h).
    [[nodiscard]] Shadow shadow_on(std::uint32_t own, double below);
    [[nodiscard]] ShadowSide side_of(std::uint32_t own, const Shadow& shadow);

    // Lists vessels that are pairwise kept apart, as one segment each: the nearest in radii first, at most
    // kMostVessels, and none beyond a squared distance in radii.
    void list_vessels(double most_radii2 = std::numeric_limits<double>::infinity());
    [[nodiscard]] const std::vector<std::uint32_t>& vessels() const { return vessels_; }
    // The owner of the point and the value of its view. Outside of all vessels: kNone and the largest value. Lists the
    // vessels that may claim the point.
    struct Verdict {
        std::uint32_t owner = kNone;
        double value = 0.0;
    };
    [[nodiscard]] Verdict judge();
    // Whether the point is within a vessel that is kept apart from the vessel of segment `own`.
    [[nodiscard]] bool is_within_another(std::uint32_t own);
    // The nearest segment in radii that is not kept apart from `place`, or kNone.
    [[nodiscard]] std::uint32_t nearest_of_vessel(std::uint32_t place);

private:
    static constexpr std::size_t kMostVessels = 6;
    // Cached results for one vessel at the point, by the segment that the vessel is seen from.
    struct Vessel {
        std::uint32_t place = kNone;
        bool knows_way = false, knows_left_out = false;
        WayOut way;
        std::vector<double> left_out; // by place
    };
    Sight find_sight();
    [[nodiscard]] std::span<const std::uint32_t> kept_apart() const { return feet_.marked.all(); }
    [[nodiscard]] Vessel& vessel(std::uint32_t place);
    [[nodiscard]] const WayOut& way_out(Vessel& own);
    [[nodiscard]] Shadow shadow_on(std::uint32_t own, const ObstacleRange& range, double below);
    [[nodiscard]] std::span<const double> left_out(Vessel& own);

    [[nodiscard]] int piece(std::uint32_t place) const { return contacts_.piece(place); }
    [[nodiscard]] glm::dvec3 foot_as_it_counts(std::uint32_t own);
    void find_zone(const GridAxes& axes);
    [[nodiscard]] const PieceShape* shape_of(std::uint32_t place) const; // null: the piece has no partners
    void list_axes();
    void list_counted_axes();
    [[nodiscard]] const AxisRelations& relations_of(int piece);
    [[nodiscard]] bool nearer(std::uint32_t a, std::uint32_t b) const; // in radii; kNone is farthest
    void group_by_piece();
    [[nodiscard]] bool any_left_out(std::uint32_t nearest); // among the axes near the point
    [[nodiscard]] bool leaves_out(std::uint32_t a, std::uint32_t b) const;

    [[nodiscard]] double claim_radii2() const { return kernel_.claim_radii * kernel_.claim_radii; }

    Kernel kernel_;
    double surface_measure_;
    // The distance in radii up to which axes count as near: the support of the kernel. The list of every brick around a
    // point contains all segments this near. Where the radius grows beyond an end, the field reaches insignificantly
    // farther.
    double reach_radii_;
    const FieldSegment* segments_;

    // State of the brick, by place.
    LocalContacts contacts_;
    SegmentIndices list_;
    struct PieceReach {
        Bounds<glm::dvec3> near, claims; // points that are near, and points that the piece may claim, with a margin
        ContactZone::Cells near_cells, claimed_cells;
        double radius = 0.0;
    };
    std::vector<PieceReach> reach_; // by piece
    ContactZone zone_;
    double beside_mm_ = 0.0;               // a point this near to a shadow may have to be moved away from it
    Axes axes_;                            // marked: pieces with partners
    std::vector<std::uint8_t> in_contact_; // whether the piece of the axis has partners, in the brick or elsewhere
    std::vector<std::uint8_t> moved_;      // whether the axis counts as moved where walls are drawn
    bool any_moved_ = false;
    Axes counted_axes_; // the moved axes; filled only if any axis is moved
    SegmentTerms terms_;
    bool terms_ready_ = false;
    std::vector<AxisRelations> relations_; // by piece, computed on first use
    std::vector<std::uint8_t> relations_ready_;

    // State of the point.
    glm::dvec3 point_{0.0};
    bool looked_ = false, terms_known_ = false;
    Sight sight_ = Sight::kPlain;
    AxisFeet feet_;
    bool sight_known_ = false, beside_contact_ = false, grouped_ = false;
    std::vector<int> near_pieces_;                // pieces with partners that are near
    std::vector<std::uint32_t> nearest_of_piece_; // by piece
    std::uint32_t nearest_of_others_ = kNone;     // among segments without a piece
    std::vector<std::uint64_t> near_piece_bits_;  // scratch
    VesselView whole_;                            // the plain sum; its gradient only if gradient_known_
    bool gradient_known_ = false;
    std::vector<std::uint32_t> vessels_, candidates_; // candidates_ is scratch
    std::array<Vessel, kMostVessels + 2> known_vessels_;
    std::size_t known_count_ = 0;
};

} // namespace ramus::field
