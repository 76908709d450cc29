#include "core/volume/skeletonize/topology.h"

#include "core/base/bounds.h"
#include "core/base/disjoint_sets.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

namespace ramus::volume {

namespace {

// The voxels [begin, end) of a row.
struct Run {
    int begin, end;
};

// The runs of a mask's rows, inside or outside, joined where they touch. Finds pieces without an array of voxels.
class Runs {
public:
    enum class Of : std::uint8_t { kInside, kOutside };

    Runs(const SparseMask& mask, Of of) : size_(mask.size()) {
        std::vector<std::uint64_t> scratch;
        first_.reserve(static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z) + 1);
        for (int k = 0; k < size_.z; ++k)
            for (int j = 0; j < size_.y; ++j) {
                first_.push_back(runs_.size());
                add_row(mask.row(j, k, scratch), of);
            }
        first_.push_back(runs_.size());
        sets_.add(runs_.size());
        const int reach = of == Of::kInside ? 1 : 0; // whether diagonal neighbours touch
        for (int k = 0; k < size_.z; ++k)
            for (int j = 0; j < size_.y; ++j) {
                join(j, k, j - 1, k, reach);
                join(j, k, j, k - 1, reach);
                if (of == Of::kInside) join(j, k, j - 1, k - 1, reach), join(j, k, j + 1, k - 1, reach);
            }
    }

    // Calls call(j, k, for_runs) for every row; for_runs(f) calls f(run, representative of its piece) for its runs.
    template <class Call> void for_rows(const Call& call) {
        for (int k = 0; k < size_.z; ++k)
            for (int j = 0; j < size_.y; ++j)
                call(j, k, [&](const auto& call_of_run) {
                    for (std::size_t r = first_of(j, k); r < first_[row(j, k) + 1]; ++r)
                        call_of_run(runs_[r], sets_.find(static_cast<std::uint32_t>(r)));
                });
    }
    // Calls call(run, j, k, representative of its piece) for every run.
    template <class Call> void for_each(const Call& call) {
        for_rows([&](int j, int k, const auto& for_runs) {
            for_runs([&](const Run& run, std::uint32_t piece) { call(run, j, k, piece); });
        });
    }
    [[nodiscard]] std::size_t count() const { return runs_.size(); }

private:
    [[nodiscard]] std::size_t row(int j, int k) const {
        return static_cast<std::size_t>(j) + static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(k);
    }
    [[nodiscard]] std::size_t first_of(int j, int k) const { return first_[row(j, k)]; }

    void add_row(std::span<const std::uint64_t> words, Of of) {
        const int end = size_.x + 1; // in bits; voxel i is bit i + 1
        const auto next = [&](int bit, bool set) {
            while (bit < end) {
                const std::uint64_t word =
                    set ? words[static_cast<std::size_t>(bit / 64)] : ~words[static_cast<std::size_t>(bit / 64)];
                const std::uint64_t rest = word >> (bit % 64);
                if (rest != 0) return std::min(bit + std::countr_zero(rest), end);
                bit = (bit / 64 + 1) * 64;
            }
            return end;
        };
        const bool inside = of == Of::kInside;
        for (int bit = next(1, inside); bit < end;) {
            const int stop = next(bit, !inside);
            runs_.push_back({bit - 1, stop - 1});
            bit = next(stop, inside);
        }
    }

    void join(int j, int k, int other_j, int other_k, int reach) {
        if (other_j < 0 || other_j >= size_.y || other_k < 0) return;
        std::size_t a = first_of(j, k), b = first_of(other_j, other_k);
        const std::size_t a_end = first_[row(j, k) + 1], b_end = first_[row(other_j, other_k) + 1];
        while (a < a_end && b < b_end) {
            if (runs_[a].begin < runs_[b].end + reach && runs_[b].begin < runs_[a].end + reach)
                sets_.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
            (runs_[a].end < runs_[b].end ? a : b) += 1;
        }
    }

    glm::ivec3 size_;
    std::vector<Run> runs_;
    std::vector<std::size_t> first_; // run of each row, and one past the last
    DisjointSets sets_;
};

// By representative: whether the piece of the outside reaches the border of the box.
std::vector<bool> open_pieces(Runs& outside, std::size_t count, const glm::ivec3& size) {
    std::vector<bool> open(count, false);
    outside.for_each([&](const Run& run, int j, int k, std::uint32_t piece) {
        if (run.begin == 0 || run.end == size.x || j == 0 || j == size.y - 1 || k == 0 || k == size.z - 1)
            open[piece] = true;
    });
    return open;
}

// Vertices minus edges plus faces minus cubes of the union of closed unit cubes, counted in words of 64.
std::int64_t euler_number(const SparseMask& mask) {
    const glm::ivec3 size = mask.size();
    const std::size_t words = mask.row_words();
    const std::vector<std::uint64_t> none(words, 0);
    const auto is_empty = [&](int j, int k) {
        return j < 0 || k < 0 || j >= size.y || k >= size.z || mask.is_empty_row(j, k);
    };
    std::array<std::vector<std::uint64_t>, 4> scratch;
    const auto row = [&](int j, int k, std::size_t n) -> std::span<const std::uint64_t> {
        return is_empty(j, k) ? std::span<const std::uint64_t>(none) : mask.row(j, k, scratch[n]);
    };
    std::int64_t number = 0;
    // Counts each cell once: at the row (j, k) that is the upper one in y and z among the rows that share the cell.
    for (int k = 0; k <= size.z; ++k)
        for (int j = 0; j <= size.y; ++j) {
            if (is_empty(j, k) && is_empty(j - 1, k) && is_empty(j, k - 1) && is_empty(j - 1, k - 1)) continue;
            const auto a = row(j, k, 0), b = row(j - 1, k, 1), c = row(j, k - 1, 2), d = row(j - 1, k - 1, 3);
            const auto upto = [&](std::size_t w, auto... rows) { return (std::uint64_t{0} | ... | rows[w]); };
            const auto count = [&](auto... rows) {
                std::int64_t crossing = 0, within = 0; // cells perpendicular to x, and along x
                std::uint64_t before = 0;
                for (std::size_t w = 0; w < words; ++w) {
                    const std::uint64_t any = upto(w, rows...);
                    within += count_bits(any);
                    crossing += count_bits(any | any << 1 | before >> 63);
                    before = any;
                }
                if (before >> 63 != 0) ++crossing;
                return std::pair(crossing, within);
            };
            const auto [face_x, cube] = count(a);
            const auto [edge_z, face_y] = count(a, b);
            const auto [edge_y, face_z] = count(a, c);
            const auto [vertex, edge_x] = count(a, b, c, d);
            number += vertex - (edge_x + edge_y + edge_z) + (face_x + face_y + face_z) - cube;
        }
    return number;
}

// The number of pieces that are not `counted` already.
std::uint64_t count_pieces(Runs& runs, std::vector<bool> counted) {
    std::uint64_t pieces = 0;
    runs.for_each([&](const Run&, int, int, std::uint32_t piece) {
        if (!counted[piece]) counted[piece] = true, ++pieces;
    });
    return pieces;
}

std::uint64_t count_cavities(const SparseMask& mask) {
    Runs outside(mask, Runs::Of::kOutside);
    return count_pieces(outside, open_pieces(outside, outside.count(), mask.size()));
}

} // namespace

Topology topology_of(const SparseMask& mask) {
    Topology found;
    {
        Runs inside(mask, Runs::Of::kInside);
        found.pieces = count_pieces(inside, std::vector<bool>(inside.count(), false));
    }
    found.cavities = count_cavities(mask);
    const std::int64_t number = euler_number(mask); // pieces - tunnels + cavities
    found.tunnels = static_cast<std::uint64_t>(static_cast<std::int64_t>(found.pieces + found.cavities) - number);
    return found;
}

std::uint64_t fill_cavities(SparseMask& mask) {
    Runs outside(mask, Runs::Of::kOutside);
    const std::vector<bool> open = open_pieces(outside, outside.count(), mask.size());
    const std::uint64_t cavities = count_pieces(outside, open);
    if (cavities == 0) return 0;
    BitMask filled(glm::ivec3(mask.size().x, 1, 1)); // a row
    std::vector<std::uint64_t> scratch;
    SparseMask::Builder builder(mask.size());
    outside.for_rows([&](int j, int k, const auto& for_runs) {
        for_runs([&](const Run& run, std::uint32_t piece) {
            if (open[piece]) return;
            for (int i = run.begin; i < run.end; ++i) filled.set({i, 0, 0});
        });
        const auto row = mask.row(j, k, scratch);
        const auto words = filled.row(0, 0);
        for (std::size_t w = 0; w < words.size(); ++w)
            builder.add(mask.first_of(j, k) + w, row[w] | std::exchange(words[w], 0));
    });
    mask = std::move(builder).finish();
    return cavities;
}

std::uint64_t drop_islands(SparseMask& mask, const glm::dvec3& spacing, double extent_mm) {
    Runs inside(mask, Runs::Of::kInside);
    using Box = Bounds<glm::ivec3>;
    std::vector<Box> boxes(inside.count());
    inside.for_each([&](const Run& run, int j, int k, std::uint32_t piece) {
        for (const int i : {run.begin, run.end - 1}) boxes[piece].hold({i, j, k});
    });
    std::uint64_t dropped = 0;
    const auto small = [&](const Box& box) {
        return glm::all(glm::lessThanEqual(spacing * glm::dvec3(box.size() + 1), glm::dvec3(extent_mm)));
    };
    for (const Box& box : boxes)
        if (box.most.x >= 0 && small(box)) ++dropped;
    inside.for_each([&](const Run& run, int j, int k, std::uint32_t piece) {
        if (small(boxes[piece]))
            for (int i = run.begin; i < run.end; ++i)
                mask.clear_bit(64 * mask.first_of(j, k) + static_cast<std::uint64_t>(i) + 1);
    });
    return dropped;
}

} // namespace ramus::volume
