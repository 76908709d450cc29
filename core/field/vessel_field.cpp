#include "core/field/vessel_field.h"

#include "core/field/separation/vessel_brick.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace ramus::field {

VesselField::VesselField(ConvolutionField sum, std::shared_ptr<const tree::Contacts> contacts, Rims rims)
    : sum_(std::move(sum)), contacts_(std::move(contacts)),
      pieces_(std::make_shared<const Pieces>(*contacts_, sum_.skeleton(), sum_.kernel())), rims_(rims) {}

VesselField VesselField::without(std::span<const std::uint8_t> hidden) const {
    return {sum_.without(hidden), contacts_, rims_};
}

std::optional<SegmentChanges> VesselField::changes_since(const VesselField& before) const {
    auto changes = sum_.changes_since(before.sum_);
    if (!changes || (contacts_->empty() && before.contacts_->empty())) return changes;
    if (contacts_->piece_of_segment != before.contacts_->piece_of_segment) return std::nullopt;
    // Unchanged segments may have other partners, or partners with other shapes.
    std::vector<std::uint32_t> others;
    for (const std::uint32_t segment : skeleton().present())
        if (!pieces_->same_around(contacts_->piece_of_segment[segment], *before.pieces_)) others.push_back(segment);
    const auto add = [&](std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& present) {
        std::vector<std::uint32_t> there;
        std::ranges::set_intersection(others, present, std::back_inserter(there));
        std::vector<std::uint32_t> both;
        std::ranges::set_union(to, there, std::back_inserter(both));
        to = std::move(both);
    };
    add(changes->before, before.skeleton().present());
    add(changes->after, skeleton().present());
    return changes;
}

ChildBounds VesselField::bound_children(SegmentIndices list, const ChildCubes& cubes,
                                        std::span<std::uint8_t> reaching) const {
    ChildBounds bounds = sum_.bound_children(list, cubes, reaching);
    if (contacts_->empty()) return bounds;
    thread_local std::vector<std::uint32_t> there;
    thread_local std::vector<std::uint32_t> scratch;
    for (std::size_t child = 0; child < kChildren; ++child) {
        if (bounds.lower[child] < isovalue()) continue;
        there.clear();
        for (std::size_t n = 0; n < list.size(); ++n)
            if ((reaching[n] >> child & 1) != 0) there.push_back(list[n]);
        // A wall may pass through a cube that is inside of both vessels.
        if (any_apart(*pieces_, there, scratch)) bounds.lower[child] = 0.0F;
    }
    return bounds;
}

bool VesselField::keeps_apart(SegmentIndices list) const {
    thread_local std::vector<std::uint32_t> scratch;
    return !contacts_->empty() && any_apart(*pieces_, list, scratch);
}

std::unique_ptr<BrickField> VesselField::in_brick() const {
    if (contacts_->empty()) return sum_.in_brick();
    auto brick = std::make_unique<VesselBrick>(sum_, *pieces_, rims_);
    brick->set_cut_ends(sum_.skeleton().cut_ends());
    return brick;
}

} // namespace ramus::field
