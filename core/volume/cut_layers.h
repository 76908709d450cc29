// Finds the edges between neighbouring voxels that the surface cuts, for one slice or layer at a time, and numbers
// them. The number of an edge is its vertex, so vertices are shared without a search: by counting bits.
#pragma once

#include "core/base/count_bits.h"
#include "core/volume/bit_mask.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::volume {

// One bit for each edge along one axis. Rows are as in BitMask, with an outside row at either end: row j of the mask is
// row j + 1 here.
struct Cuts {
    std::vector<std::uint64_t> words;
    std::vector<std::uint32_t> before; // by word: number of cut edges of the slice or layer before it

    [[nodiscard]] std::uint32_t number_of(std::size_t word, std::size_t bit) const {
        return before[word] + count_bits(words[word] & ((std::uint64_t{1} << bit) - 1));
    }
};

// The rows of a mask, and outside rows beyond its border.
class PaddedRows {
public:
    explicit PaddedRows(const BitMask& mask) : mask_(mask), outside_(mask.row_words(), 0) {}
    [[nodiscard]] const std::uint64_t* row(int j, int k) const {
        const glm::ivec3& size = mask_.size();
        return j < 0 || k < 0 || j >= size.y || k >= size.z ? outside_.data() : mask_.row(j, k).data();
    }
    [[nodiscard]] const BitMask& mask() const { return mask_; }

private:
    const BitMask& mask_;
    std::vector<std::uint64_t> outside_;
};

// Edges within slice k along x and y, numbered together, row by row.
struct SliceCuts {
    Cuts x, y;
    std::uint64_t count = 0;
    void find(const PaddedRows& rows, int k);
};

// Edges from slice k to the next.
struct LayerCuts {
    Cuts z;
    std::uint64_t count = 0;
    void find(const PaddedRows& rows, int k);
};

// The right neighbours of the voxels in a word of a row.
[[nodiscard]] inline std::uint64_t right_of(const std::uint64_t* row, std::size_t word, std::size_t words) {
    return row[word] >> 1 | (word + 1 < words ? row[word + 1] << 63 : 0);
}

// Calls visit(row, word, bit, inside) in order for every cell between the slices k and k + 1 that the surface cuts. The
// cell's lowest corner is bit `bit` of word `word` in row `row` of Cuts; `inside` is its case (cell_table.h).
template <class Visit> void for_cut_cells(const PaddedRows& rows, int k, const Visit& visit) {
    const std::size_t words = rows.mask().row_words();
    for (int j = -1; j < rows.mask().size().y; ++j) {
        const std::uint64_t* const row[4] = {rows.row(j, k), rows.row(j + 1, k), rows.row(j, k + 1),
                                             rows.row(j + 1, k + 1)};
        const auto any_in = [&](std::size_t word) {
            return word < words ? row[0][word] | row[1][word] | row[2][word] | row[3][word] : 0;
        };
        std::uint64_t next = any_in(0);
        for (std::size_t word = 0; word < words; ++word) {
            std::uint64_t any = next;
            next = any_in(word + 1);
            any |= any >> 1 | next << 63;
            if (any == 0) continue;
            std::uint64_t all = ~std::uint64_t{0};
            std::uint64_t left[4];
            std::uint64_t right[4];
            for (int n = 0; n < 4; ++n) {
                left[n] = row[n][word];
                right[n] = right_of(row[n], word, words);
                all &= left[n] & right[n];
            }
            for (std::uint64_t cells = any & ~all; cells != 0; cells &= cells - 1) {
                const int bit = std::countr_zero(cells);
                unsigned inside = 0;
                for (int n = 0; n < 4; ++n)
                    inside |= static_cast<unsigned>((left[n] >> bit & 1) | (right[n] >> bit & 1) << 1) << (2 * n);
                visit(static_cast<std::size_t>(j + 1), word, static_cast<std::size_t>(bit), inside);
            }
        }
    }
}

} // namespace ramus::volume
