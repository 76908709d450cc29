// VesselViews: what the vessels around one point make of it, where some are kept apart (vessel_field.h).
#pragma once

#include "core/field/apart/axes.h"
#include "core/field/apart/local_contacts.h"
#include "core/field/kernel.h"
#include "core/tree/contacts/contacts.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace ramus::field {

// A segment that reaches the point.
struct SeenSegment {
    std::uint32_t place = 0; // in the brick's list
    int piece = -1;          // as LocalContacts numbers it
    std::uint32_t axis = 0;  // among the axes of what is kept apart, where piece >= 0
    double distance = 0.0;   // of the axis, mm
    double radius = 0.0;     // at the foot, mm
    double relative2 = 0.0;  // the distance in radii, squared
    glm::dvec3 foot{0.0};    // mm
};

// The field as one vessel sees it.
struct VesselView {
    std::size_t seen = 0; // the vessel's segment that is nearest, in radii
    double value = 0.0;
    glm::dvec3 gradient{0.0};
};

class VesselViews {
public:
    static constexpr std::size_t kNone = ~std::size_t{0};

    // `segments`: of the whole field.
    VesselViews(const Kernel& kernel, const FieldSegment* segments, const Pieces& pieces);

    // Begins a brick. Whether vessels are kept apart there; only then the rest may be asked.
    bool enter(SegmentIndices list);
    [[nodiscard]] const LocalContacts& contacts() const { return contacts_; }
    [[nodiscard]] SegmentIndices list() const { return list_; }
    [[nodiscard]] float isovalue() const { return static_cast<float>(kernel_.isovalue); }
    [[nodiscard]] double surface_phi() const { return surface_phi_; } // sqrt(-ln isovalue)

    // The plain sum holds; it holds, but the point is behind another vessel, which takes it away; or parts of the sum
    // are left out.
    enum class Sight : std::uint8_t { kPlain, kCut, kParted };
    // Looks at a point, given in mm.
    Sight look(const glm::dvec3& point);
    [[nodiscard]] const glm::dvec3& point() const { return point_; }
    // After a plain sight: sees what the others see.
    void see_all();
    // After any sight, without seeing all: the nearest segment in radii by its place in the list; kNone.
    [[nodiscard]] std::size_t nearest_place();
    // After a plain sight: whether no vessel is near that is kept apart from another one.
    [[nodiscard]] bool alone() const { return kept_feet_.near.empty(); }
    // After a plain sight: whether a vessel's way to the point may be cut nearby.
    [[nodiscard]] bool beside_contact() const { return beside_contact_; }
    // What was seen from there, in the list's order, but after a plain sight. The next ones add the segments' terms.
    [[nodiscard]] const std::vector<SeenSegment>& seen() const { return seen_; }
    [[nodiscard]] std::uint64_t add_terms(); // returns the number of kernels evaluated
    [[nodiscard]] const SegmentTerms& terms() const { return terms_; }

    [[nodiscard]] std::int32_t branch(std::size_t seen) const { return segments_[list_[seen_[seen].place]].branch; }

    [[nodiscard]] bool apart(const SeenSegment& a, const SeenSegment& b) const {
        return contacts_.apart(a.piece, b.piece);
    }
    // How much of b's term is left out where the field is seen from a: 0 to 1.
    [[nodiscard]] double left_out(const SeenSegment& a, const SeenSegment& b) const;
    [[nodiscard]] VesselView view(std::size_t seen) const;

    // How far a vessel's axis is from the point, as it counts where walls are drawn: the way from the nearest place.
    [[nodiscard]] glm::dvec3 way_from(std::size_t seen) const { return point_ - foot_as_it_counts(seen_[seen]); }
    // How far the point is from what lies behind an obstacle, seen from a vessel's axis.
    [[nodiscard]] Shadow shadow_on(const SeenSegment& own) const;
    [[nodiscard]] glm::dvec3 toward(const SeenSegment& own, const Shadow& shadow) const;

    // One segment of each vessel that is seen, apart from each other: the nearest in radii first.
    void list_vessels();
    [[nodiscard]] const std::vector<std::size_t>& vessels() const { return vessels_; }
    // Of the vessels listed the one that the point belongs to, and its view; or, outside all of them, the strongest
    // view and kNone.
    struct Verdict {
        std::size_t owner = kNone; // in seen()
        double value = 0.0;
    };
    [[nodiscard]] Verdict judge() const;
    // The nearest segment in radii that is not apart from the one given (by its place in the list), or kNone.
    [[nodiscard]] std::size_t nearest_of_vessel(std::uint32_t place) const;

private:
    [[nodiscard]] glm::dvec3 foot_as_it_counts(const SeenSegment& own) const;
    [[nodiscard]] WayOut way_out(const SeenSegment& own) const;
    void add_term(std::size_t seen, double share, VesselView& view) const;
    void list_axes();
    void list_counted_axes();
    void find_others(); // once for a point
    [[nodiscard]] SeenSegment seen_on(const Axes& axes, const AxisFeet& feet, const std::vector<std::uint32_t>& places,
                                      std::uint32_t axis) const;
    [[nodiscard]] bool any_left_out();                                     // of what is near
    [[nodiscard]] bool leaves_out(std::uint32_t a, std::uint32_t b) const; // of axes kept apart

    Kernel kernel_;
    double surface_phi_, merged_;
    // In radii at the foot, what is looked at. So far each segment is in the list of every brick around a point; what
    // it may reach beyond its ends, where radii go on growing, is next to nothing.
    double reach_radii_;
    const FieldSegment* segments_;
    LocalContacts contacts_;
    SegmentIndices list_;
    glm::dvec3 point_{0.0};
    // Places in the list: those whose pieces have partners, and the rest; with their axes, and the feet of the point.
    std::vector<std::uint32_t> kept_apart_, others_;
    std::vector<int> piece_of_axis_;       // of those kept apart
    std::vector<std::uint8_t> axis_moved_; // of those kept apart, where walls are drawn
    Axes kept_axes_, other_axes_;
    AxisFeet kept_feet_, other_feet_;
    bool others_known_ = false; // whether other_feet_ are the point's
    // Of those kept apart, as they count, where any is moved.
    Axes counted_axes_;
    bool any_moved_ = false;
    mutable AxisFeet counted_feet_;
    mutable bool counted_known_ = false;
    std::vector<SeenSegment> seen_;
    std::vector<std::uint32_t> seen_kept_;   // of these, the ones that are kept apart
    VesselView whole_;                       // the terms of all
    std::vector<std::uint64_t> near_pieces_; // scratch: one bit each
    bool beside_contact_ = false;
    std::vector<std::size_t> vessels_;
    std::vector<std::uint32_t> left_; // scratch
    SegmentTerms terms_;
};

} // namespace ramus::field
