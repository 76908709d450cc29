#include "core/volume/skeletonize/voxel_set.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::volume {

namespace {

struct Box {
    glm::ivec3 least, most; // both within
};

// Of the bits that are set; empty: least > most.
Box box_of(const BitMask& mask) {
    Box box{mask.size(), glm::ivec3(-1)};
    for (int k = 0; k < mask.size().z; ++k)
        for (int j = 0; j < mask.size().y; ++j) {
            const auto row = mask.row(j, k);
            const auto is_set = [](std::uint64_t word) { return word != 0; };
            const auto first = std::ranges::find_if(row, is_set);
            if (first == row.end()) continue;
            auto last = row.end() - 1;
            while (*last == 0) --last;
            const int from = static_cast<int>(first - row.begin()) * 64 + std::countr_zero(*first) - 1;
            const int to = static_cast<int>(last - row.begin()) * 64 + 63 - std::countl_zero(*last) - 1;
            box.least = glm::min(box.least, glm::ivec3(from, j, k));
            box.most = glm::max(box.most, glm::ivec3(to, j, k));
        }
    return box;
}

// Of the box with a border of outside in y and z; rows have theirs in x.
glm::ivec3 bordered(const Box& box) { return glm::max(box.most - box.least + 1, glm::ivec3(0)) + glm::ivec3(0, 2, 2); }

void copy_row(std::span<const std::uint64_t> from, std::size_t skipped, std::span<std::uint64_t> to) {
    const std::size_t words = skipped / 64, shift = skipped % 64;
    for (std::size_t w = 0; w < to.size(); ++w) {
        const std::size_t at = w + words;
        if (at >= from.size()) break;
        to[w] = from[at] >> shift;
        if (shift != 0 && at + 1 < from.size()) to[w] |= from[at + 1] << (64 - shift);
    }
}

} // namespace

VoxelSet::VoxelSet(const BitMask& mask, const glm::dvec3& spacing) : spacing_(spacing), bits_(glm::ivec3(0)) {
    const Box box = box_of(mask);
    bits_ = BitMask(bordered(box));
    origin_ = box.least - glm::ivec3(0, 1, 1);
    for (int k = box.least.z; k <= box.most.z; ++k)
        for (int j = box.least.y; j <= box.most.y; ++j)
            copy_row(mask.row(j, k), static_cast<std::size_t>(box.least.x), bits_.row(j - origin_.y, k - origin_.z));
    renumber();
}

void VoxelSet::renumber() {
    const std::size_t words =
        bits_.row_words() * static_cast<std::size_t>(bits_.size().y) * static_cast<std::size_t>(bits_.size().z);
    ranks_.resize(words);
    count_ = 0;
    for (std::size_t w = 0; w < words; ++w) {
        ranks_[w] = count_;
        count_ += count_bits(this->words()[w]);
    }
}

double VoxelSet::step_mm(int bit) const {
    return glm::length(spacing_ * glm::dvec3(bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1));
}

} // namespace ramus::volume
