// A box of cubic cells that knows which tubes (line segments with a radius) come near which point. Tubes have small
// integer ids, chosen by the caller, and may be moved and removed. Queries are conservative: they return every tube
// that touches the asked one, and some that do not. The order of what they return depends only on the calls before.
#pragma once

#include "core/tree/grow/exact_math.h"

#include <vector>

namespace ramus::tree::growth {

class SegmentGrid {
public:
    SegmentGrid(const Vec& low, const Vec& high, double cell_mm);

    // Puts tube `id` from a to b; if it is there already it moves.
    void insert(int id, const Vec& a, const Vec& b, double radius);
    void remove(int id);
    // Replaces `found` by the ids of all tubes that may touch this one, each once.
    void query(const Vec& a, const Vec& b, double radius, std::vector<int>& found) const;

private:
    struct Tube {
        Vec a{0.0};
        Vec b{0.0};
        double radius = -1.0; // negative: not there
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
