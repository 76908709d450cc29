// VesselField: a field in which vessels blend along the tree, and stay separate at contacts (core/tree/contacts). A
// model of field.h. core/field/separation/README.md explains the method.
//
// The view of a segment i is Phi_i(p) = sum_j (1 - m_ij(p)) h_j(p). m_ij is 0 unless j is a partner of i, which is a
// segment that i is kept apart from. For a partner, m_ij is 1 where the feet of p on the two axes are as close as
// vessels that merge, and falls to 0 at the closeness `apart_from` of the contact. A vessel claims p if its Phi(p) is
// at or above the isovalue. If several vessels claim p, it belongs to the vessel with the nearest axis, so each vessel
// keeps at least half of the axis distance. A vessel also loses the points behind another vessel, seen from its own
// axis. So every way from an axis outward crosses the vessel's surface once, and a vessel has no tunnel where another
// one runs through it. Where no m is above 0 and no point is lost, the field is the plain sum, to the last bit.
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
    // `contacts` must belong to the tree of `sum`.
    VesselField(ConvolutionField sum, std::shared_ptr<const tree::Contacts> contacts, Rims rims = Rims::kApart);
    // The same without the branches (ids in the file's tree) whose entry is not 0.
    [[nodiscard]] VesselField without(std::span<const std::uint8_t> hidden) const;
    [[nodiscard]] const ConvolutionField& sum() const { return sum_; }
    [[nodiscard]] const tree::Contacts& contacts() const { return *contacts_; }

    // The functions of FieldModel.
    [[nodiscard]] const Skeleton& skeleton() const { return sum_.skeleton(); }
    [[nodiscard]] float isovalue() const { return sum_.isovalue(); }
    [[nodiscard]] double support_radii() const { return sum_.support_radii(); }
    [[nodiscard]] std::optional<SegmentChanges> changes_since(const VesselField& before) const;
    [[nodiscard]] ChildBounds bound_children(SegmentIndices list, const ChildCubes& cubes,
                                             std::span<std::uint8_t> reaching) const;
    [[nodiscard]] bool keeps_apart(SegmentIndices list) const;
    [[nodiscard]] std::unique_ptr<BrickField> in_brick() const;

private:
    ConvolutionField sum_;
    std::shared_ptr<const tree::Contacts> contacts_;
    std::shared_ptr<const Pieces> pieces_;
    Rims rims_;
};

} // namespace ramus::field
