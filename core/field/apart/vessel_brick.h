// VesselBrick: a VesselField in one brick after another. The plain sum does all the work where no vessels are kept
// apart, and the rest of it elsewhere.
#pragma once

#include "core/field/apart/vessel_views.h"
#include "core/field/apart/wall.h"
#include "core/field/convolution_field.h"
#include "core/field/rims.h"
#include "core/field/separation.h"

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

    [[nodiscard]] std::uint32_t place_of(Owner owner) const; // in the list
    // The same; where nothing is kept apart and nobody owns the point, of the segment that is nearest to it.
    [[nodiscard]] std::uint32_t place_near(Owner owner, const glm::dvec3& point);
    // What becomes of the plain sum at a point, and whose it is: kNoOwner where nothing is kept apart.
    struct Verdict {
        float value = 0.0F;
        Owner owner = kNoOwner;
    };
    Verdict judge(const glm::dvec3& point, float plain);
    float value_at(const glm::dvec3& point, float plain);
    Owner owner_at(const glm::dvec3& point); // of one that is inside
    [[nodiscard]] bool is_beside_contact(const glm::dvec3& point);
    [[nodiscard]] Bounds<glm::dvec3> bounds_of(const OwnedGuess& one, const glm::dvec3& middle, double reach) const;

    // Owners of points that were sampled lately, in this brick or another one: they are asked for soon after, and where
    // bricks touch by both.
    struct Known {
        glm::dvec3 point{0.0};
        Owner owner = kNoOwner;
        bool is_known = false;
    };
    Known& known(const glm::dvec3& point);

    std::unique_ptr<BrickField> sum_;
    const FieldSegment* segments_;
    VesselViews views_;
    Rims rims_;
    double onward_ = 0.0; // mm: from so far below their vessel's own surface points of walls go on to it
    GridAxes axes_;
    bool parts_ = false;
    std::vector<Known> known_;  // by a number made of the point; empty until it is needed
    std::uint64_t kernels_ = 0; // evaluated since this was last asked for
};

} // namespace ramus::field
