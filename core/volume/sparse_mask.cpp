#include "core/volume/sparse_mask.h"

#include <algorithm>
#include <utility>

namespace ramus::volume {

namespace {

// All words are stored if there are at most so many (32 MB), or if a fourth of them hold voxels.
constexpr std::size_t kFewWords = std::size_t{1} << 22U;
constexpr std::size_t kMostPerFilled = 4;

std::size_t words_per_row(const glm::ivec3& size) { return (static_cast<std::size_t>(size.x) + 2 + 63) / 64; }

std::size_t words_of(const glm::ivec3& size) {
    return words_per_row(size) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
}

} // namespace

SparseMask::Builder::Builder(const glm::ivec3& size)
    : size_(size), filled_((words_of(size) + kGroup - 1) / kGroup, 0) {}

void SparseMask::Builder::begin(std::size_t word) {
    filled_[word / kGroup] |= std::uint32_t{1} << word % kGroup;
    words_.push_back(0);
    last_ = word;
}

SparseMask SparseMask::Builder::finish(Words stored) && {
    SparseMask mask(glm::ivec3(0));
    mask.size_ = size_;
    mask.row_words_ = words_per_row(size_);
    const std::size_t all = words_of(size_);
    const std::size_t few = stored == Words::kAllIfFew ? kFewWords : 0;
    if (all <= std::max(few, kMostPerFilled * words_.size())) {
        mask.words_.assign(all, 0);
        std::size_t place = 0;
        for (std::size_t g = 0; g < filled_.size(); ++g)
            for (std::uint32_t left = filled_[g]; left != 0; left &= left - 1)
                mask.words_[g * kGroup + static_cast<std::size_t>(std::countr_zero(left))] = words_[place++];
        return mask;
    }
    LargeArray<Group> groups(filled_.size());
    std::uint32_t first = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        groups[g] = {first, filled_[g]};
        first += count_bits(filled_[g]);
    }
    mask.groups_ = std::make_shared<const LargeArray<Group>>(std::move(groups));
    mask.words_.assign(words_.begin(), words_.end());
    return mask;
}

SparseMask::SparseMask(const glm::ivec3& size) : size_(size), row_words_(words_per_row(size)) {
    const std::size_t all = words_of(size);
    if (all <= kFewWords)
        words_.assign(all, 0);
    else
        groups_ = std::make_shared<const LargeArray<Group>>((all + kGroup - 1) / kGroup);
}

SparseMask::SparseMask(const BitMask& mask) : SparseMask(glm::ivec3(0)) {
    Builder builder(mask.size());
    for (int k = 0; k < mask.size().z; ++k) {
        const auto slice = mask.slice(k);
        const std::size_t first = slice.size() * static_cast<std::size_t>(k);
        for (std::size_t w = 0; w < slice.size(); ++w) builder.add(first + w, slice[w]);
    }
    *this = std::move(builder).finish();
}

BitMask bit_mask_of(const SparseMask& mask) {
    BitMask bits(mask.size());
    const auto rows = static_cast<std::size_t>(mask.size().y);
    mask.for_words([&](std::size_t word, std::uint64_t filled) {
        const std::size_t row = word / mask.row_words();
        bits.row(static_cast<int>(row % rows), static_cast<int>(row / rows))[word % mask.row_words()] = filled;
    });
    return bits;
}

bool SparseMask::test(const glm::ivec3& voxel) const {
    for (int axis = 0; axis < 3; ++axis)
        if (voxel[axis] < 0 || voxel[axis] >= size_[axis]) return false;
    const auto bit = static_cast<std::size_t>(voxel.x) + 1;
    return (word(first_of(voxel.y, voxel.z) + bit / 64) >> bit % 64 & 1) != 0;
}

std::uint64_t SparseMask::count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : words_) sum += count_bits(word);
    return sum;
}

bool SparseMask::is_empty_row(int j, int k) const {
    const std::size_t first = first_of(j, k), end = first + row_words_;
    if (groups_ == nullptr)
        return std::all_of(words_.begin() + static_cast<std::ptrdiff_t>(first),
                           words_.begin() + static_cast<std::ptrdiff_t>(end), [](std::uint64_t w) { return w == 0; });
    for (std::size_t g = first / kGroup; g * kGroup < end; ++g) {
        std::uint32_t filled = (*groups_)[g].filled;
        if (g * kGroup < first) filled &= ~std::uint32_t{0} << first % kGroup;
        if ((g + 1) * kGroup > end) filled &= (std::uint32_t{1} << end % kGroup) - 1;
        for (; filled != 0; filled &= filled - 1)
            if (word(g * kGroup + static_cast<std::size_t>(std::countr_zero(filled))) != 0) return false;
    }
    return true;
}

std::span<const std::uint64_t> SparseMask::row(int j, int k, std::vector<std::uint64_t>& scratch) const {
    const std::size_t first = first_of(j, k);
    if (groups_ == nullptr) return {words_.data() + first, row_words_};
    scratch.assign(row_words_, 0);
    if (!is_empty_row(j, k))
        for (std::size_t w = 0; w < row_words_; ++w) scratch[w] = word(first + w);
    return scratch;
}

} // namespace ramus::volume
