// VesselBrick: evaluates a VesselField in one brick after another. It passes every call to the brick of the plain sum,
// and then corrects the points at which vessels are kept apart. Implements BrickField; positions are in mm.
#pragma once

#include "core/field/convolution_field.h"
#include "core/field/rims.h"
#include "core/field/separation.h"
#include "core/field/separation/vessel_views.h"
#include "core/field/separation/wall.h"

#include <memory>
#include <vector>

namespace ramus::field {

class VesselBrick final : public BrickField, private Separation {
public:
    VesselBrick(const ConvolutionField& sum, const Pieces& pieces, Rims rims);

    void enter(SegmentIndices list, const GridAxes& axes) override;
    std::uint64_t sample_groups(unsigned groups, GridGroups& samples) override;
    std::uint64_t sample_lattice(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                 std::span<float> values) override;
    std::uint64_t project(Projection& guesses, const SurfacePoints& to) override { return sum_->project(guesses, to); }
    void find_depths(const GridValues& values, GridValues& depths) const override { sum_->find_depths(values, depths); }
    [[nodiscard]] float crossing(float from, float to) const override { return sum_->crossing(from, to); }

    [[nodiscard]] Separation* separation() override { return parts_ ? this : nullptr; }

private:
    std::uint64_t find_owners(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                              std::span<Owner> owners) override;
    [[nodiscard]] int piece_of(Owner owner) const override;
    [[nodiscard]] bool apart_pieces(int a, int b) const override { return views_.contacts().apart(a, b); }
    [[nodiscard]] bool beside_contact(const glm::vec3& at) override {
        return is_beside_contact(axes_.corner() + glm::dvec3(at));
    }
    [[nodiscard]] DrawnPoint draw(const OwnedGuess& whose, const glm::vec3& guess, float onward) override;
    std::uint64_t project_apart(const Projection& guesses, std::span<const OwnedGuess> owned,
                                const SurfacePoints& to) override;

    [[nodiscard]] std::uint32_t place_of(Owner owner) const; // index in the brick's list
    // place_of(), or for kNoOwner the segment nearest to the point, in radii.
    [[nodiscard]] std::uint32_t place_near(Owner owner, const glm::dvec3& point);
    // The value of the field at a point and its owner; kNoOwner where nothing is kept apart.
    struct Verdict {
        float value = 0.0F;
        Owner owner = kNoOwner;
    };
    Verdict judge(const glm::dvec3& point, float plain);
    float value_at(const glm::dvec3& point, float plain);
    Owner owner_at(const glm::dvec3& point); // of a point inside the surface
    [[nodiscard]] bool is_beside_contact(const glm::dvec3& point);
    [[nodiscard]] Bounds<glm::dvec3> bounds_of(const OwnedGuess& one, const glm::dvec3& middle, double reach) const;

    // A cache of the owners of points that were sampled: the polygonizer needs the owners of a point soon after its
    // value. Those of another brick are not used. Whether a point has an owner may differ there, and which bricks a
    // thread has seen before depends on the other threads.
    struct Known {
        glm::dvec3 point{0.0};
        Owner owner = kNoOwner;
        std::uint32_t brick = 0; // its number among those entered; 0: none
    };
    Known& known(const glm::dvec3& point);

    std::unique_ptr<BrickField> sum_;
    const FieldSegment* segments_;
    VesselViews views_;
    Rims rims_;
    double onward_ = 0.0; // mm: wall vertices at most this far below their vessel's own surface move on to it
    GridAxes axes_;
    bool parts_ = false;
    std::vector<Known> known_;  // by a hash of the point; empty until first use
    std::uint32_t brick_ = 0;   // the number of bricks entered
    std::uint64_t kernels_ = 0; // kernels evaluated since the count was last returned
};

} // namespace ramus::field
