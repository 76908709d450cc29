// Field: what the polygonizer needs of a scalar field around a skeleton of segments, and nothing of how it is computed.
//
// A field is any type that satisfies FieldModel; ConvolutionField is the first. Field wraps a model so that the
// polygonizer is compiled once.
//
// Every model keeps to this, or meshes are not closed or not the same for any number of threads:
// - A point's value has the same bits whichever brick asks for it, and whatever its list holds beyond the segments that
//   reach the point.
// - Beyond support_radii from a segment, in its local radius, the segment changes nothing.
// - Bounds hold for every sample within the cube. "Inside" is: a value at or above the isovalue.
// - All functions may be called from many threads; what in_brick() returns, from one at a time.
#pragma once

#include "core/field/brick_field.h"
#include "core/field/skeleton.h"

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace ramus::field {

template <class M>
concept FieldModel = std::copy_constructible<M> && requires(const M& model, const M& before, SegmentIndices list,
                                                            const ChildCubes& cubes, std::span<std::uint8_t> reaching) {
    { model.skeleton() } -> std::same_as<const Skeleton&>;
    { model.isovalue() } -> std::same_as<float>;
    { model.support_radii() } -> std::same_as<double>;
    // Bounds over the children of a cube, from the segments in `list`. `reaching` receives for each of them one bit per
    // child that its support reaches. Where the field may reach the isovalue the upper bound says only that.
    { model.bound_children(list, cubes, reaching) } -> std::same_as<ChildBounds>;
    // Whether vessels may be kept apart in a cube that these segments reach, which takes far longer than the rest.
    { model.keeps_apart(list) } -> std::same_as<bool>;
    // Which segments make the field differ from an earlier state; nothing when all of it may.
    { model.changes_since(before) } -> std::same_as<std::optional<SegmentChanges>>;
    // The same without the branches (ids in the file's tree) whose entry is not 0.
    { model.without(reaching) } -> std::same_as<M>;
    // Must not outlive the model.
    { model.in_brick() } -> std::same_as<std::unique_ptr<BrickField>>;
};

// A model, whatever it is. A value: copies share it.
class Field {
public:
    template <class M>
    requires(!std::same_as<M, Field> && FieldModel<M>) Field(M model)
        : model_(std::make_shared<const Of<M>>(std::move(model))) {} // NOLINT: a model is a field

    [[nodiscard]] const Skeleton& skeleton() const { return model_->skeleton(); }
    [[nodiscard]] const Extent& extent() const { return skeleton().extent(); }
    [[nodiscard]] float isovalue() const { return model_->isovalue(); }
    [[nodiscard]] double support_radii() const { return model_->support_radii(); }
    [[nodiscard]] ChildBounds bound_children(SegmentIndices list, const ChildCubes& cubes,
                                             std::span<std::uint8_t> reaching) const {
        return model_->bound_children(list, cubes, reaching);
    }
    [[nodiscard]] bool keeps_apart(SegmentIndices list) const { return model_->keeps_apart(list); }
    // Nothing for a state of another model, too.
    [[nodiscard]] std::optional<SegmentChanges> changes_since(const Field& before) const {
        return model_->changes_since(*before.model_);
    }
    [[nodiscard]] Field without(std::span<const std::uint8_t> hidden) const { return Field(model_->without(hidden)); }
    [[nodiscard]] std::unique_ptr<BrickField> in_brick() const { return model_->in_brick(); }

private:
    struct Any {
        virtual ~Any() = default;
        [[nodiscard]] virtual const Skeleton& skeleton() const = 0;
        [[nodiscard]] virtual float isovalue() const = 0;
        [[nodiscard]] virtual double support_radii() const = 0;
        [[nodiscard]] virtual ChildBounds bound_children(SegmentIndices list, const ChildCubes& cubes,
                                                         std::span<std::uint8_t> reaching) const = 0;
        [[nodiscard]] virtual bool keeps_apart(SegmentIndices list) const = 0;
        [[nodiscard]] virtual std::optional<SegmentChanges> changes_since(const Any& before) const = 0;
        [[nodiscard]] virtual std::shared_ptr<const Any> without(std::span<const std::uint8_t> hidden) const = 0;
        [[nodiscard]] virtual std::unique_ptr<BrickField> in_brick() const = 0;
    };
    template <class M> struct Of final : Any {
        explicit Of(M m) : model(std::move(m)) {}
        [[nodiscard]] const Skeleton& skeleton() const override { return model.skeleton(); }
        [[nodiscard]] float isovalue() const override { return model.isovalue(); }
        [[nodiscard]] double support_radii() const override { return model.support_radii(); }
        [[nodiscard]] ChildBounds bound_children(SegmentIndices list, const ChildCubes& cubes,
                                                 std::span<std::uint8_t> reaching) const override {
            return model.bound_children(list, cubes, reaching);
        }
        [[nodiscard]] bool keeps_apart(SegmentIndices list) const override { return model.keeps_apart(list); }
        [[nodiscard]] std::optional<SegmentChanges> changes_since(const Any& before) const override {
            const auto* same = dynamic_cast<const Of*>(&before);
            return same != nullptr ? model.changes_since(same->model) : std::nullopt;
        }
        [[nodiscard]] std::shared_ptr<const Any> without(std::span<const std::uint8_t> hidden) const override {
            return std::make_shared<const Of>(model.without(hidden));
        }
        [[nodiscard]] std::unique_ptr<BrickField> in_brick() const override { return model.in_brick(); }
        M model;
    };
    explicit Field(std::shared_ptr<const Any> model) : model_(std::move(model)) {}

    std::shared_ptr<const Any> model_;
};

} // namespace ramus::field
