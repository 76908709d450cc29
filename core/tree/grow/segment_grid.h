// SegmentGrid: a uniform grid over a box to find tubes (line segments with a radius, mm) near a tube. Tubes have small
// integer ids, chosen by the caller, and may be moved and removed. Queries are conservative: they return every tube
// that touches the given one, and some that do not. The order of the result depends only on the previous calls.
#pragma once

#include "core/tree/grow/exact_math.h"

#include <vector>

namespace ramus::tree::growth {

class SegmentGrid {
public:
    SegmentGrid(const Vec& low, const Vec& high, double cell_mm);

    // Adds tube `id` from a to b, or moves it.
    void insert(int id, const Vec& a, const Vec& b, double radius);
    void remove(int id);
    // Replaces `found` by the ids of all tubes that may touch this one, each once.
    void query(const Vec& a, const Vec& b, double radius, std::vector<int>& found) const;

private:
    struct Tube {
        Vec a{0.0};
        Vec b{0.0};
        double radius = -1.0; // negative: no tube
    };
    template <class Visit> void for_cells(const Tube& tube, Visit visit) const;

    Vec low_;
    double cell_mm_;
    int size_[3];
    std::vector<std::vector<int>> cells_;
    std::vector<Tube> tubes_;
    mutable std::vector<unsigned> stamp_;
    mutable unsigned now_ = 0;
};

} // namespace ramus::tree::growth
