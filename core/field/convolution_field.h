// ConvolutionField: the scalar field F(p) = sum_i h_i(p) of a vessel tree after Oeltze & Preim (2005), the sum of one
// kernel over all segments. A model of field.h; with the Gaussian it is the paper's.
#pragma once

#include "core/field/kernel.h"
#include "core/field/skeleton.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace ramus::field {

class ConvolutionField {
public:
    ConvolutionField(Skeleton skeleton, const Kernel& kernel);
    // With the Gaussian of this width.
    ConvolutionField(const tree::PreparedTree& prepared, double width);
    // The same without the branches (ids in the file's tree) whose entry is not 0.
    [[nodiscard]] ConvolutionField without(std::span<const std::uint8_t> hidden) const;

    [[nodiscard]] const Kernel& kernel() const { return kernel_; }
    [[nodiscard]] const Extent& extent() const { return skeleton_.extent(); }
    [[nodiscard]] const std::vector<FieldSegment>& segments() const { return skeleton_.segments(); }
    [[nodiscard]] const std::vector<std::uint32_t>& present() const { return skeleton_.present(); }

    // The functions of FieldModel.
    [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
    [[nodiscard]] float isovalue() const { return static_cast<float>(kernel_.isovalue); }
    [[nodiscard]] double support_radii() const { return kernel_.support_radii; }
    [[nodiscard]] std::optional<SegmentChanges> changes_since(const ConvolutionField& before) const;
    [[nodiscard]] ChildBounds bound_children(SegmentIndices list, const ChildCubes& cubes,
                                             std::span<std::uint8_t> reaching) const {
        return kernel_.sum->bound_children(kernel_, culling_->of(skeleton_), list, cubes, reaching);
    }
    [[nodiscard]] bool keeps_apart(SegmentIndices /*list*/) const { return false; }
    [[nodiscard]] std::unique_ptr<BrickField> in_brick(Choice choice = Choice::kReaching) const {
        auto brick = kernel_.sum->in_brick(kernel_, segments().data(), choice);
        brick->set_cut_ends(skeleton_.cut_ends());
        return brick;
    }

private:
    // For all segments, present or not. Made when it is first asked for, because contacts are searched before, which
    // takes memory.
    class Culling {
    public:
        [[nodiscard]] const CullingSegment* of(const Skeleton& skeleton);

    private:
        std::once_flag made_;
        std::vector<CullingSegment> segments_;
    };

    Kernel kernel_;
    Skeleton skeleton_;
    std::shared_ptr<Culling> culling_;
};

} // namespace ramus::field
