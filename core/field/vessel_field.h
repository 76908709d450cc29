// VesselField: the plain sum of one kernel along the tree, and not across contacts (core/tree/contacts/contacts.h). A
// model of field.h.
//
// Seen from a segment i the field is Phi_i(p) = sum_j (1 - m_ij(p)) h_j(p). m is 0 for all segments j but those that i
// is kept apart from; for these it is 1 where the feet of p on the two are as close as vessels that merge, and fades to
// 0 where they are as far apart as the contact says. A vessel claims p where its Phi is at or above the isovalue. Where
// several claim p it belongs to the one whose axis is nearest, so each keeps at least half the axis distance. What lies
// behind another vessel, seen from the own axis, is given up as well: every way from the axis outward crosses a
// vessel's surface once, so that a vessel has no tunnel where another one runs through it. Where no m is above 0 and
// nothing is given up the field is the plain sum, to the bit.
#pragma once

#include "core/field/convolution_field.h"
#include "core/field/rims.h"
#include "core/field/separation/pieces.h"
#include "core/tree/contacts/contacts.h"

#include <memory>
#include <optional>
#include <span>

namespace ramus::field {

class VesselField {
public:
    // `contacts`: of the tree whose segments the sum is of.
    VesselField(ConvolutionField sum, std::shared_ptr<const tree::Contacts> contacts, Rims rims = Rims::kApart);
    // The same without the branches (ids in the file's tree) whose entry is not 0.
    [[nodiscard]] VesselField without(std::span<const std::uint8_t> hidden) const;
    [[nodiscard]] const ConvolutionField& sum() const { return sum_; }
    [[nodiscard]] const tree::Contacts& contacts() const { return *contacts_; }

    // As FieldModel asks.
    [[nodiscard]] const Skeleton& skeleton() const { return sum_.skeleton(); }
    [[nodiscard]] float isovalue() const { return sum_.isovalue(); }
    [[nodiscard]] double support_radii() const { return sum_.support_radii(); }
    [[nodiscard]] std::optional<SegmentChanges> changes_since(const VesselField& before) const;
    [[nodiscard]] ChildBounds bound_children(SegmentIndices list, const ChildCubes& cubes,
                                             std::span<std::uint8_t> reaching) const;
    [[nodiscard]] std::unique_ptr<BrickField> in_brick() const;

private:
    ConvolutionField sum_;
    std::shared_ptr<const tree::Contacts> contacts_;
    std::shared_ptr<const Pieces> pieces_;
    Rims rims_;
};

} // namespace ramus::field
