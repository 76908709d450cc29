// Field: what the polygonizer needs of a scalar field around a skeleton of segments, and nothing of how it is computed.
//
// A field is any type that satisfies FieldModel; ConvolutionField is the first. What happens inside a brick is the
// model's own code, compiled for it as a whole (vectorised, per kernel and instruction set). Field wraps a model so
// that the polygonizer is compiled once: a call through it costs one indirection, for some hundred points or more.
//
// Every model keeps to this, or meshes are not closed or not the same for any number of threads:
// - A point's value has the same bits whichever brick asks for it, and whatever its list holds beyond the segments that
//   reach the point.
// - Beyond support_radii from a segment, in its local radius, the segment changes nothing.
// - Bounds hold for every sample within the cube. "Inside" is: a value at or above the isovalue.
// - All functions may be called from many threads; what in_brick() returns, from one at a time.
#pragma once

#include "core/field/child_bounds.h"
#include "core/field/projection.h"
#include "core/field/samples.h"
#include "core/field/skeleton.h"

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace ramus::field {

using SegmentIndices = std::span<const std::uint32_t>; // ascending

// The field in one brick after another, with the memory that this takes. Counts returned: kernels evaluated, one for
// each segment and point.
template <class B>
concept FieldInBrick = requires(B brick, SegmentIndices list, const GridAxes& axes, unsigned groups,
                                GridGroups& samples, const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                std::span<float> values, Projection& guesses, const SurfacePoints& to,
                                const GridValues& grid, GridValues& depths, float value) {
    // Begins a brick: the segments that reach it, which must outlive the stay, and the coordinates of its grid points.
    brick.enter(list, axes);
    // Values at the groups of grid points that have their bits set.
    { brick.sample_groups(groups, samples) } -> std::same_as<std::uint64_t>;
    // Values at points of a finer lattice with the same corner in the same box.
    { brick.sample_lattice(lattice, points, values) } -> std::same_as<std::uint64_t>;
    // Moves points onto the surface. Each stays within its reach.
    { brick.project(guesses, to) } -> std::same_as<std::uint64_t>;
    // From values to numbers that are nearly linear in the distance from the surface: 0 or more inside, less outside.
    brick.find_depths(grid, depths);
    // The share of the way along an edge, from one value to another, at which the surface crosses it.
    { brick.crossing(value, value) } -> std::same_as<float>;
};

template <class M>
concept FieldModel = std::copy_constructible<M> && requires(const M& model, const M& before, SegmentIndices list,
                                                            const ChildCubes& cubes, std::span<std::uint8_t> reaching) {
    { model.skeleton() } -> std::same_as<const Skeleton&>;
    { model.isovalue() } -> std::same_as<float>;
    { model.support_radii() } -> std::same_as<double>;
    // Bounds over the children of a cube, from the segments in `list`. `reaching` receives for each of them one bit per
    // child that its support reaches. Where the field may reach the isovalue the upper bound says only that.
    { model.bound_children(list, cubes, reaching) } -> std::same_as<ChildBounds>;
    // Which segments make the field differ from an earlier state; nothing when all of it may.
    { model.changes_since(before) } -> std::same_as<std::optional<SegmentChanges>>;
    { model.in_brick() } -> FieldInBrick;
};

// A model's in_brick(), whatever the model.
class BrickField {
public:
    virtual ~BrickField() = default;
    virtual void enter(SegmentIndices list, const GridAxes& axes) = 0;
    virtual std::uint64_t sample_groups(unsigned groups, GridGroups& samples) = 0;
    virtual std::uint64_t sample_lattice(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                         std::span<float> values) = 0;
    virtual std::uint64_t project(Projection& guesses, const SurfacePoints& to) = 0;
    virtual void find_depths(const GridValues& grid, GridValues& depths) = 0;
    virtual float crossing(float from, float to) = 0;
};

template <FieldInBrick B> class BrickFieldOf final : public BrickField {
public:
    explicit BrickFieldOf(B brick) : brick_(std::move(brick)) {}
    void enter(SegmentIndices list, const GridAxes& axes) override { brick_.enter(list, axes); }
    std::uint64_t sample_groups(unsigned groups, GridGroups& samples) override {
        return brick_.sample_groups(groups, samples);
    }
    std::uint64_t sample_lattice(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                 std::span<float> values) override {
        return brick_.sample_lattice(lattice, points, values);
    }
    std::uint64_t project(Projection& guesses, const SurfacePoints& to) override { return brick_.project(guesses, to); }
    void find_depths(const GridValues& grid, GridValues& depths) override { brick_.find_depths(grid, depths); }
    float crossing(float from, float to) override { return brick_.crossing(from, to); }

private:
    B brick_;
};

// A model, whatever it is. A value: copies share it.
class Field {
public:
    template <class M>
    requires(!std::same_as<M, Field> && FieldModel<M>) Field(M model)
        : model_(std::make_shared<const Of<M>>(std::move(model))) {} // NOLINT: a model is a field

    [[nodiscard]] const Skeleton& skeleton() const { return model_->skeleton(); }
    [[nodiscard]] const Frame& frame() const { return skeleton().frame(); }
    [[nodiscard]] float isovalue() const { return model_->isovalue(); }
    [[nodiscard]] double support_radii() const { return model_->support_radii(); }
    [[nodiscard]] ChildBounds bound_children(SegmentIndices list, const ChildCubes& cubes,
                                             std::span<std::uint8_t> reaching) const {
        return model_->bound_children(list, cubes, reaching);
    }
    // Nothing for a state of another model, too.
    [[nodiscard]] std::optional<SegmentChanges> changes_since(const Field& before) const {
        return model_->changes_since(*before.model_);
    }
    // Must not outlive the field.
    [[nodiscard]] std::unique_ptr<BrickField> in_brick() const { return model_->in_brick(); }

private:
    struct Any {
        virtual ~Any() = default;
        [[nodiscard]] virtual const Skeleton& skeleton() const = 0;
        [[nodiscard]] virtual float isovalue() const = 0;
        [[nodiscard]] virtual double support_radii() const = 0;
        [[nodiscard]] virtual ChildBounds bound_children(SegmentIndices list, const ChildCubes& cubes,
                                                         std::span<std::uint8_t> reaching) const = 0;
        [[nodiscard]] virtual std::optional<SegmentChanges> changes_since(const Any& before) const = 0;
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
        [[nodiscard]] std::optional<SegmentChanges> changes_since(const Any& before) const override {
            const auto* same = dynamic_cast<const Of*>(&before);
            return same != nullptr ? model.changes_since(same->model) : std::nullopt;
        }
        [[nodiscard]] std::unique_ptr<BrickField> in_brick() const override {
            return std::make_unique<BrickFieldOf<decltype(model.in_brick())>>(model.in_brick());
        }
        M model;
    };
    std::shared_ptr<const Any> model_;
};

} // namespace ramus::field
