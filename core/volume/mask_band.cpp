#include "core/volume/mask_band.h"

#include "core/volume/cut_layers.h"

#include <algorithm>
#include <array>
#include <functional>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::volume {

namespace {

constexpr int kThinVoxels = 4; // smoothing would shrink thinner parts, and close thinner gaps

BitMask with_border(const BitMask& mask, int width) {
    BitMask wider(mask.size() + 2 * width);
    tbb::parallel_for(0, mask.size().z, [&](int k) {
        for (int j = 0; j < mask.size().y; ++j) {
            const auto from = mask.row(j, k);
            const auto to = wider.row(j + width, k + width);
            for (std::size_t word = 0; word < to.size(); ++word)
                to[word] =
                    (word < from.size() ? from[word] << width : 0) | (word > 0 ? from[word - 1] >> (64 - width) : 0);
        }
    });
    return wider;
}

// Applies combine(word, words of the six neighbours) to each word of voxels.
template <class Combine> BitMask of_neighbours(const BitMask& mask, const Combine& combine) {
    BitMask result(mask.size());
    const PaddedRows rows(mask);
    const std::size_t words = mask.row_words();
    tbb::parallel_for(0, mask.size().z, [&](int k) {
        for (int j = 0; j < mask.size().y; ++j) {
            const std::uint64_t* const here = rows.row(j, k);
            const std::uint64_t* const beside[4] = {rows.row(j - 1, k), rows.row(j + 1, k), rows.row(j, k - 1),
                                                    rows.row(j, k + 1)};
            const auto to = result.row(j, k);
            for (std::size_t w = 0; w < words; ++w) {
                const std::uint64_t left = here[w] << 1 | (w > 0 ? here[w - 1] >> 63 : 0);
                to[w] = combine(here[w], std::array{left, right_of(here, w, words), beside[0][w], beside[1][w],
                                                    beside[2][w], beside[3][w]});
            }
        }
    });
    return result;
}

BitMask beside_boundary(const BitMask& mask) {
    return of_neighbours(mask, [](std::uint64_t here, const auto& beside) {
        std::uint64_t other = 0;
        for (const std::uint64_t word : beside) other |= here ^ word;
        return other;
    });
}

BitMask grown_by_one(const BitMask& mask) {
    return of_neighbours(mask, [](std::uint64_t here, const auto& beside) {
        for (const std::uint64_t word : beside) here |= word;
        return here;
    });
}

BitMask shrunk_by_one(const BitMask& mask) {
    return of_neighbours(mask, [](std::uint64_t here, const auto& beside) {
        for (const std::uint64_t word : beside) here &= word;
        return here;
    });
}

// Combines each voxel with the kThinVoxels - 1 next (step 1) or previous (step -1) ones along all axes.
template <class Combine> BitMask of_box(const BitMask& mask, int step, const Combine& combine) {
    const std::size_t words = mask.row_words();
    BitMask along_x(mask.size());
    BitMask result(mask.size());
    tbb::parallel_for(0, mask.size().z, [&](int k) {
        for (int j = 0; j < mask.size().y; ++j) {
            const auto from = mask.row(j, k);
            const auto to = along_x.row(j, k);
            for (std::size_t w = 0; w < words; ++w) {
                to[w] = from[w];
                for (int n = 1; n < kThinVoxels; ++n)
                    to[w] = combine(to[w], step > 0 ? from[w] >> n | (w + 1 < words ? from[w + 1] << (64 - n) : 0)
                                                    : from[w] << n | (w > 0 ? from[w - 1] >> (64 - n) : 0));
            }
        }
    });
    const PaddedRows rows(along_x);
    tbb::parallel_for(0, mask.size().z, [&](int k) {
        for (int j = 0; j < mask.size().y; ++j) {
            const auto to = result.row(j, k);
            std::ranges::copy(along_x.row(j, k), to.begin());
            for (int n = 1; n < kThinVoxels * kThinVoxels; ++n) {
                const std::uint64_t* const other = rows.row(j + step * (n % kThinVoxels), k + step * (n / kThinVoxels));
                for (std::size_t w = 0; w < words; ++w) to[w] = combine(to[w], other[w]);
            }
        }
    });
    return result;
}

BitMask of_words(const BitMask& a, const BitMask& b, const auto& combine) {
    BitMask result(a.size());
    for (int k = 0; k < a.size().z; ++k)
        for (int j = 0; j < a.size().y; ++j)
            std::ranges::transform(a.row(j, k), b.row(j, k), result.row(j, k).begin(), combine);
    return result;
}

// Parts of the inside and of the outside into which no cube of kThinVoxels voxels fits (morphological opening and
// closing), and their surroundings. Voxels near a place where a cube fits are roughness and do not count.
BitMask thin_parts(const BitMask& mask) {
    const auto all = std::bit_and<std::uint64_t>();
    const auto any = std::bit_or<std::uint64_t>();
    const auto without = [](std::uint64_t a, std::uint64_t b) { return a & ~b; };
    const BitMask opened = of_box(of_box(mask, 1, all), -1, any);
    const BitMask vessels = of_words(mask, grown_by_one(grown_by_one(opened)), without);
    const BitMask closed = of_words(mask, of_box(of_box(mask, -1, any), 1, all), any);
    const BitMask gaps = of_words(shrunk_by_one(shrunk_by_one(closed)), mask, without);
    return grown_by_one(grown_by_one(of_words(vessels, gaps, any)));
}

} // namespace

MaskBand::MaskBand(const BitMask& mask)
    : padded_(with_border(mask, kBeyond)), band_(grown_by_one(beside_boundary(padded_))) {
    const glm::ivec3& size = band_.size();
    before_.resize(first_word(0, size.z));
    for (int k = 0; k < size.z; ++k) {
        const auto words = band_.slice(k);
        for (std::size_t w = 0; w < words.size(); ++w) {
            before_[first_word(0, k) + w] = static_cast<std::uint32_t>(size_);
            size_ += count_bits(words[w]);
        }
    }
}

MaskBand::Numbered MaskBand::numbered() const {
    Numbered all;
    all.neighbours.resize(size_);
    all.inside.resize(size_);
    all.thin.resize(size_);
    const BitMask thin = thin_parts(padded_);
    for_padded([&](std::uint32_t number, const glm::ivec3& at) {
        all.inside[number] = padded_.test(at) ? 1 : 0;
        all.thin[number] = thin.test(at) ? 1 : 0;
        for (std::size_t side = 0; side < 6; ++side) {
            glm::ivec3 next = at;
            next[static_cast<int>(side / 2)] += side % 2 == 0 ? -1 : 1;
            all.neighbours[number][side] = number_or_none(next);
        }
    });
    return all;
}

} // namespace ramus::volume
