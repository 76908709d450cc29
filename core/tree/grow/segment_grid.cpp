#include "core/tree/grow/segment_grid.h"

#include "core/base/lines.h"

#include <algorithm>
#include <cmath>

namespace ramus::tree::growth {

SegmentGrid::SegmentGrid(const Vec& low, const Vec& high, double cell_mm) : low_(low), cell_mm_(cell_mm) {
    for (int axis = 0; axis < 3; ++axis)
        size_[axis] = std::max(1, static_cast<int>(std::ceil((high[axis] - low[axis]) / cell_mm)));
    cells_.resize(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
}

template <class Visit> void SegmentGrid::for_cells(const Tube& tube, Visit visit) const {
    int first[3];
    int last[3];
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = std::min(tube.a[axis], tube.b[axis]) - tube.radius;
        const double upper = std::max(tube.a[axis], tube.b[axis]) + tube.radius;
        // Parts outside of the box are stored in its outermost cells.
        const auto cell = [&](double at) {
            return static_cast<int>(std::clamp(std::floor((at - low_[axis]) / cell_mm_), 0.0, size_[axis] - 1.0));
        };
        first[axis] = cell(lower);
        last[axis] = cell(upper);
    }
    const bool small = (last[0] - first[0] + 1) * (last[1] - first[1] + 1) * (last[2] - first[2] + 1) <= 8;
    const Vec run = tube.b - tube.a;
    const double reach = tube.radius + 0.8661 * cell_mm_; // half a cell's diagonal
    for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j)
            for (int i = first[0]; i <= last[0]; ++i) {
                const bool border = i == 0 || j == 0 || k == 0 || i == size_[0] - 1 || j == size_[1] - 1 ||
                                    k == size_[2] - 1; // may stand for points far outside
                if (!small && !border) {
                    const Vec centre = low_ + cell_mm_ * (Vec(i, j, k) + 0.5);
                    const Vec d = centre - tube.a - share_along(centre - tube.a, run) * run;
                    if (glm::dot(d, d) > reach * reach) continue;
                }
                visit((static_cast<std::size_t>(k) * size_[1] + j) * size_[0] + i);
            }
}

void SegmentGrid::insert(int id, const Vec& a, const Vec& b, double radius) {
    const auto at = static_cast<std::size_t>(id);
    if (at >= tubes_.size()) {
        tubes_.resize(at + 1);
        stamp_.resize(at + 1, 0);
    }
    if (tubes_[at].radius >= 0.0) remove(id);
    tubes_[at] = {a, b, radius};
    for_cells(tubes_[at], [&](std::size_t cell) { cells_[cell].push_back(id); });
}

void SegmentGrid::remove(int id) {
    Tube& tube = tubes_[static_cast<std::size_t>(id)];
    for_cells(tube, [&](std::size_t cell) {
        auto& ids = cells_[cell];
        const auto at = std::find(ids.begin(), ids.end(), id);
        *at = ids.back();
        ids.pop_back();
    });
    tube.radius = -1.0;
}

void SegmentGrid::query(const Vec& a, const Vec& b, double radius, std::vector<int>& found) const {
    found.clear();
    ++now_;
    for_cells(Tube{a, b, radius}, [&](std::size_t cell) {
        for (const int id : cells_[cell]) {
            unsigned& stamp = stamp_[static_cast<std::size_t>(id)];
            if (stamp == now_) continue;
            stamp = now_;
            found.push_back(id);
        }
    });
}

} // namespace ramus::tree::growth
