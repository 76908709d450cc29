// VesselViews: what the vessels around one point make of it, where some are kept apart (vessel_field.h).
#pragma once

#include "core/field/apart/local_contacts.h"
#include "core/field/kernel.h"
#include "core/tree/contacts/contacts.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::field {

// A segment that reaches the point.
struct SeenSegment {
    std::uint32_t place = 0; // in the brick's list
    int piece = -1;          // as LocalContacts numbers it
    double distance = 0.0;   // of the axis, mm
    double radius = 0.0;     // at the foot, mm
    glm::dvec3 foot{0.0};    // mm
    [[nodiscard]] double relative() const { return distance / radius; }
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
    // After a plain sight: whether no vessel is near that is kept apart from another one.
    [[nodiscard]] bool alone() const { return near_.empty(); }
    // After a plain sight: whether a vessel's way to the point may be cut nearby.
    [[nodiscard]] bool beside_contact() const { return beside_contact_; }
    // What was seen from there, in the list's order, but after a plain sight. The next ones add the segments' terms.
    [[nodiscard]] const std::vector<SeenSegment>& seen() const { return seen_; }
    [[nodiscard]] std::uint64_t add_terms(); // returns the number of kernels evaluated
    [[nodiscard]] const SegmentTerms& terms() const { return terms_; }

    [[nodiscard]] std::int32_t branch(std::size_t seen) const { return segments_[list_[seen_[seen].place]].branch; }
    [[nodiscard]] std::size_t nearest() const; // in radii, or kNone

    [[nodiscard]] bool apart(const SeenSegment& a, const SeenSegment& b) const {
        return contacts_.apart(a.piece, b.piece);
    }
    // How much of b's term is left out where the field is seen from a: 0 to 1.
    [[nodiscard]] double left_out(const SeenSegment& a, const SeenSegment& b) const;
    [[nodiscard]] VesselView view(std::size_t seen) const;

    // How far the axes of two vessels are from the point, as they count where the wall between them is drawn: with the
    // way from each.
    struct Beside {
        glm::dvec3 from_own{0.0}, from_other{0.0}; // mm
    };
    [[nodiscard]] Beside beside(std::size_t own, std::size_t other) const;
    // How far the point is from what lies behind an obstacle, seen from a vessel's axis, mm: negative within. With the
    // way there, unit.
    struct Shadow {
        double spare = 0.0;
        glm::dvec3 toward{0.0};
    };
    [[nodiscard]] Shadow nearest_shadow(const SeenSegment& own) const;

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
    // From an axis outward.
    struct Way {
        glm::dvec3 foot, direction; // mm; unit
        double length, radius;      // mm, of the vessel
    };
    [[nodiscard]] Way way_to(const SeenSegment& own) const;
    [[nodiscard]] Shadow shadow_of(const Obstacle& obstacle, const Way& way) const;
    // The nearest place of a vessel whose axis is moved.
    [[nodiscard]] SeenSegment moved(const SeenSegment& own, const glm::dvec3& aside) const;
    [[nodiscard]] bool any_left_out(); // of what is near
    [[nodiscard]] bool leaves_out(const SeenSegment& a, const SeenSegment& b) const;

    Kernel kernel_;
    double surface_phi_, merged_;
    const FieldSegment* segments_;
    LocalContacts contacts_;
    SegmentIndices list_;
    glm::dvec3 point_{0.0};
    std::vector<std::uint32_t> kept_apart_; // places in the list whose pieces have partners
    std::vector<SeenSegment> near_;         // of these
    std::vector<SeenSegment> seen_;
    std::vector<std::uint64_t> near_pieces_; // scratch: one bit each
    bool beside_contact_ = false;
    std::vector<std::size_t> vessels_;
    SegmentTerms terms_;
};

} // namespace ramus::field
