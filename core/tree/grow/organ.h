// The organ that a tree grows in: an interface, and a liver as a smooth union of ellipsoids (lobes) with hollows carved
// out of it (hilum, caval groove, renal impression), of which every seed gives a slightly different person. The organ
// of a mask is in core/organ/grow_in.h. Coordinates are mm, RAS.
//
// Guarantees: the hilum, the trunks and the sector points lie inside. depth_mm() is positive inside and near the true
// distance to the surface there, good enough to keep a margin; far outside it is only a sign.
#pragma once

#include "core/tree/grow/exact_math.h"

#include <vector>

namespace ramus::tree::growth {

class Organ {
public:
    virtual ~Organ() = default;

    [[nodiscard]] virtual double depth_mm(const Vec& point) const = 0;
    [[nodiscard]] const Vec& low() const { return low_; }
    [[nodiscard]] const Vec& high() const { return high_; }
    [[nodiscard]] double volume_mm3() const { return volume_mm3_; }
    // Thickness of the tissue that must be left between a vessel's wall and the surface.
    [[nodiscard]] double capsule_mm() const { return capsule_mm_; }

    // The start of the stem, outside, and its first fork, inside.
    [[nodiscard]] const Vec& root() const { return root_; }
    [[nodiscard]] const Vec& hilum() const { return hilum_; }
    // The first trunks of every tree: each from the end of another (its index; -1: from the hilum). At least two leave
    // the hilum.
    struct Trunk {
        int from;
        Vec end;
    };
    [[nodiscard]] const std::vector<Trunk>& trunks() const { return trunks_; }
    // Inner points of further sectors, in the order in which they get vessels.
    [[nodiscard]] const std::vector<Vec>& sectors() const { return sectors_; }

protected:
    Organ() = default;
    Organ(const Organ&) = default;
    Organ& operator=(const Organ&) = default;

    Vec low_{0.0};
    Vec high_{0.0};
    Vec root_{0.0};
    Vec hilum_{0.0};
    std::vector<Trunk> trunks_;
    std::vector<Vec> sectors_;
    double volume_mm3_ = 0.0;
    double capsule_mm_ = 1.0;
};

class Liver final : public Organ {
public:
    // width_mm: extent from the tip of the left lobe to the right side.
    Liver(double width_mm, Random& random);

    [[nodiscard]] double depth_mm(const Vec& point) const override;

private:
    struct Blob {
        Vec centre;
        Vec semi_axes;
    };
    std::vector<Blob> lobes_;
    std::vector<Blob> hollows_;
    double blend_ = 0.0; // mm over which neighbouring blobs flow into each other
};

} // namespace ramus::tree::growth
