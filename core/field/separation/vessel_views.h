// VesselViews: what the vessels around one point make of it, where some are kept apart (vessel_field.h).
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

// The field as one vessel sees it.
struct VesselView {
    std::uint32_t place = 0; // of the vessel's segment that is nearest, in radii
    double value = 0.0;
    glm::dvec3 gradient{0.0};
};

// Segments are named by their places in the brick's list.
class VesselViews {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    // `segments`: of the whole field.
    VesselViews(const Kernel& kernel, const FieldSegment* segments, const Pieces& pieces);

    // Begins a brick. Whether vessels are kept apart there or nearby; only then the rest may be asked.
    bool enter(SegmentIndices list, const GridAxes& axes);
    // Whether it makes a difference to look at a point: elsewhere the sight is plain, and no edge of the grid leads
    // from one vessel to another that is kept apart from it.
    [[nodiscard]] bool in_zone(const glm::dvec3& point) const { return zone_.has(point); }
    [[nodiscard]] const LocalContacts& contacts() const { return contacts_; }
    [[nodiscard]] SegmentIndices list() const { return list_; }
    [[nodiscard]] float isovalue() const { return static_cast<float>(kernel_.isovalue); }
    // From a value of the field how far out that is, and on the surface (LongVessel).
    [[nodiscard]] LongVessel::Place place_of(double value) const { return kernel_.long_vessel->place(kernel_, value); }
    [[nodiscard]] double surface_measure() const { return surface_measure_; }

    // The plain sum holds; it holds, but the point is behind another vessel, which takes it away; or parts of the sum
    // are left out.
    enum class Sight : std::uint8_t { kPlain, kCut, kParted };
    // Looks at a point, given in mm; at that of the last time it knows what it saw.
    void look(const glm::dvec3& point);
    [[nodiscard]] Sight sight();
    [[nodiscard]] const glm::dvec3& point() const { return point_; }
    // The segments that reach it, ascending; whether none of them is kept apart from another one; the nearest in radii,
    // or kNone.
    [[nodiscard]] std::span<const std::uint32_t> seen() const { return feet_.near.all(); }
    [[nodiscard]] bool alone() const { return feet_.marked.count == 0; }
    [[nodiscard]] std::uint32_t nearest() const { return seen().empty() ? kNone : feet_.near.nearest; }
    // Whether the point may be a segment's: it is no farther away than vessels claim points.
    [[nodiscard]] bool may_claim(std::uint32_t place) const {
        return feet_.of(place, kFootRelative2) <= claim_radii2();
    }
    // Of a plain sight: whether a vessel's way to the point may be cut nearby.
    [[nodiscard]] bool beside_contact() const { return beside_contact_; }

    // Of a point where the plain sum is known: whether the nearest vessel has it whatever is left out, since all that
    // it is kept apart from is too far away to claim it, and too weak. Then nothing cuts it off either.
    [[nodiscard]] bool is_undisputed(float plain);

    // Of a segment: the distance of its axis in mm, the radius at the foot, and the foot.
    [[nodiscard]] double distance(std::uint32_t place) const;
    [[nodiscard]] double radius(std::uint32_t place) const { return feet_.of(place, kFootRadius); }
    [[nodiscard]] double tree_radius(std::uint32_t place) const; // the tree's there, not the kernel's
    [[nodiscard]] glm::dvec3 foot(std::uint32_t place) const { return feet_.foot(place); }
    [[nodiscard]] std::int32_t branch(std::uint32_t place) const { return segments_[list_[place]].branch; }
    [[nodiscard]] bool apart(std::uint32_t a, std::uint32_t b) const { return contacts_.apart(piece(a), piece(b)); }

    // Evaluates the segments' terms where they are not known; returns how many it did. What follows needs them.
    [[nodiscard]] std::uint64_t add_terms();
    [[nodiscard]] double term(std::uint32_t place) const {
        return static_cast<double>(terms_.row(SegmentTerms::kValue)[place]);
    }
    // How much of each segment's term is left out where the field is seen from one of them, 0 to 1, by place.
    [[nodiscard]] std::span<const double> left_out(std::uint32_t own) { return left_out(vessel(own)); }
    [[nodiscard]] VesselView view(std::uint32_t own);
    [[nodiscard]] double value(std::uint32_t own); // of the view

    // How far a vessel's axis is from the point, as it counts where walls are drawn: the way from the nearest place.
    [[nodiscard]] glm::dvec3 way_from(std::uint32_t own) { return point_ - way_out(vessel(own)).foot; }
    // How far the point is from what lies behind an obstacle, seen from a vessel's axis: that is found where it is
    // `below` so much.
    [[nodiscard]] Shadow shadow_on(std::uint32_t own, double below);
    [[nodiscard]] ShadowSide side_of(std::uint32_t own, const Shadow& shadow);

    // One segment of each vessel that is seen, apart from each other: the nearest in radii first, up to so many radii,
    // squared.
    void list_vessels(double most_radii2 = std::numeric_limits<double>::infinity());
    [[nodiscard]] const std::vector<std::uint32_t>& vessels() const { return vessels_; }
    // Lists the vessels that may claim the point: the one that it belongs to, and its view; or, outside all of them,
    // the strongest view and kNone.
    struct Verdict {
        std::uint32_t owner = kNone;
        double value = 0.0;
    };
    [[nodiscard]] Verdict judge();
    // Whether a vessel that is kept apart from a segment's claims the point.
    [[nodiscard]] bool is_within_another(std::uint32_t own);
    // The nearest segment in radii that is not apart from the one given, or kNone.
    [[nodiscard]] std::uint32_t nearest_of_vessel(std::uint32_t place);

private:
    static constexpr std::size_t kMostVessels = 6;
    // What is known of a vessel at the point, by the segment that it is seen from.
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
    [[nodiscard]] const PieceShape* shape_of(std::uint32_t place) const; // null: it is in contact with nothing
    void list_axes();
    void list_counted_axes();
    [[nodiscard]] const AxisRelations& relations_of(int piece);        // of all axes
    [[nodiscard]] bool nearer(std::uint32_t a, std::uint32_t b) const; // in radii; any is nearer than kNone
    void group_by_piece();
    [[nodiscard]] bool any_left_out(std::uint32_t nearest); // of what is near
    [[nodiscard]] bool leaves_out(std::uint32_t a, std::uint32_t b) const;

    [[nodiscard]] double claim_radii2() const { return kernel_.claim_radii * kernel_.claim_radii; }

    Kernel kernel_;
    double surface_measure_;
    // In radii at the foot, what is looked at; less beyond ends from which radii go on shrinking. So far each segment
    // is in the list of every brick around a point; what it may reach beyond ends from which they grow is next to
    // nothing.
    double reach_radii_;
    const FieldSegment* segments_;

    // Of the brick, by place.
    LocalContacts contacts_;
    SegmentIndices list_;
    struct PieceReach {
        Bounds<glm::dvec3> near, claims; // where a point is near, and where it may be the piece's or next to such a one
        ContactZone::Cells near_cells, claimed_cells;
        double radius = 0.0;
    };
    std::vector<PieceReach> reach_; // by piece
    ContactZone zone_;
    double beside_mm_ = 0.0; // so near to what is cut off a point may have to be moved
    Axes axes_;
    std::vector<std::uint8_t> in_contact_; // whether the axis is of a piece with partners, here or elsewhere
    std::vector<std::uint8_t> moved_;      // whether it counts as moved, where walls are drawn
    bool any_moved_ = false;
    Axes counted_axes_; // as they count, where any is moved
    SegmentTerms terms_;
    bool terms_ready_ = false;
    std::vector<AxisRelations> relations_; // by piece, as far as asked for
    std::vector<std::uint8_t> relations_ready_;

    // Of the point.
    glm::dvec3 point_{0.0};
    bool looked_ = false, terms_known_ = false;
    Sight sight_ = Sight::kPlain;
    AxisFeet feet_; // marked: of pieces with partners here
    bool sight_known_ = false, beside_contact_ = false, grouped_ = false;
    std::vector<int> near_pieces_;                // of those kept apart
    std::vector<std::uint32_t> nearest_of_piece_; // by piece, of those near
    std::uint32_t nearest_of_others_ = kNone;     // of those that are not kept apart
    std::vector<std::uint64_t> near_piece_bits_;  // scratch
    VesselView whole_;                            // the terms of all, with their gradients once they are asked for
    bool gradient_known_ = false;
    std::vector<std::uint32_t> vessels_, candidates_; // the second: scratch
    std::array<Vessel, kMostVessels + 2> known_vessels_;
    std::size_t known_count_ = 0;
};

} // namespace ramus::field
