#include "core/field/convolution_field.h"

#include "core/field/kernels/gaussian.h"

#include <utility>

namespace ramus::field {

const CullingSegment* ConvolutionField::Culling::of(const Skeleton& skeleton) {
    std::call_once(made_, [&] {
        const glm::dvec3 origin = skeleton.extent().middle();
        segments_.reserve(skeleton.segments().size());
        for (const FieldSegment& s : skeleton.segments())
            segments_.push_back({static_cast<float>(s.ax - origin.x), static_cast<float>(s.ay - origin.y),
                                 static_cast<float>(s.az - origin.z), s.ux, s.uy, s.uz, s.length, s.radius, s.slope,
                                 s.beyond, s.thickest()});
    });
    return segments_.data();
}

ConvolutionField::ConvolutionField(Skeleton skeleton, const Kernel& kernel)
    : kernel_(kernel), skeleton_(std::move(skeleton)), culling_(std::make_shared<Culling>()) {}

ConvolutionField::ConvolutionField(const tree::PreparedTree& prepared, double width)
    : ConvolutionField(Skeleton(prepared, gaussian(width).support_radii), gaussian(width)) {}

ConvolutionField ConvolutionField::without(std::span<const std::uint8_t> hidden) const {
    ConvolutionField rest = *this;
    rest.skeleton_ = skeleton_.without(hidden);
    return rest;
}

std::optional<SegmentChanges> ConvolutionField::changes_since(const ConvolutionField& before) const {
    if (kernel_ != before.kernel_) return std::nullopt;
    return skeleton_.changes_since(before.skeleton_);
}

} // namespace ramus::field
