// ConvolutionField: the scalar field F(p) = sum_i h_i(p) of a vessel tree after Oeltze & Preim (2005), the sum of one
// kernel over all segments. A model of field.h; with the Gaussian it is the paper's.
#pragma once

#include "core/field/kernel.h"
#include "core/field/skeleton.h"
#include "core/field/sum/local_segments.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ramus::field {

class SumInBrick;

class ConvolutionField {
public:
    ConvolutionField(Skeleton skeleton, const Kernel& kernel);
    // With the Gaussian of this width.
    ConvolutionField(const tree::PreparedTree& prepared, double width);
    // The same without the branches (ids in the file's tree) whose entry is not 0.
    [[nodiscard]] ConvolutionField without(std::span<const std::uint8_t> hidden) const;

    [[nodiscard]] const Kernel& kernel() const { return kernel_; }
    [[nodiscard]] const Frame& frame() const { return skeleton_.frame(); }
    [[nodiscard]] const std::vector<FieldSegment>& segments() const { return skeleton_.segments(); }
    [[nodiscard]] const std::vector<std::uint32_t>& present() const { return skeleton_.present(); }

    // As FieldModel asks.
    [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
    [[nodiscard]] float isovalue() const { return static_cast<float>(kernel_.isovalue); }
    [[nodiscard]] double support_radii() const { return kernel_.support_radii; }
    [[nodiscard]] std::optional<SegmentChanges> changes_since(const ConvolutionField& before) const;
    [[nodiscard]] ChildBounds bound_children(std::span<const std::uint32_t> list, const ChildCubes& cubes,
                                             std::span<std::uint8_t> reaching) const {
        return kernel_.functions->bound_children(kernel_, culling_->data(), list, cubes, reaching);
    }
    [[nodiscard]] SumInBrick in_brick() const;

private:
    Kernel kernel_;
    Skeleton skeleton_;
    std::shared_ptr<const std::vector<CullingSegment>> culling_; // of all segments, present or not
};

// The sum in one brick after another, as FieldInBrick asks.
class SumInBrick {
public:
    explicit SumInBrick(const ConvolutionField& field);

    void enter(std::span<const std::uint32_t> list, const GridAxes& axes) { gather_segments(list, axes, local_); }
    std::uint64_t sample_groups(unsigned groups, GridGroups& samples, Choice choice = Choice::kReaching) {
        return local_.kernel->functions->sample_groups(local_, groups, samples, choice);
    }
    std::uint64_t sample_lattice(const LatticeAxes& axes, std::span<const LatticePoint> points,
                                 std::span<float> values) {
        return local_.kernel->functions->sample_lattice(local_, axes, points, values);
    }
    std::uint64_t project(Projection& guesses, const SurfacePoints& to);
    void find_depths(const GridValues& values, GridValues& depths) const {
        local_.kernel->functions->find_depths(*local_.kernel, values, depths);
    }
    [[nodiscard]] float crossing(float from, float to) const {
        return local_.kernel->functions->crossing(*local_.kernel, from, to);
    }

private:
    LocalSegments local_;
};

} // namespace ramus::field
