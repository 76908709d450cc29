#include "core/volume/skeletonize/voxel_set.h"

#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

namespace ramus::volume {

namespace {

struct Box {
    glm::ivec3 least, most; // both within
};

// The bounding box of the set bits. Empty: least > most.
Box box_of(const SparseMask& mask) {
    Box box{mask.size(), glm::ivec3(-1)};
    const auto height = static_cast<std::size_t>(mask.size().y);
    mask.for_words([&](std::size_t w, std::uint64_t word) {
        const std::size_t row = w / mask.row_words();
        const int first = static_cast<int>(w % mask.row_words()) * 64 - 1;
        const glm::ivec2 jk(static_cast<int>(row % height), static_cast<int>(row / height));
        box.least = glm::min(box.least, glm::ivec3(first + std::countr_zero(word), jk));
        box.most = glm::max(box.most, glm::ivec3(first + 63 - std::countl_zero(word), jk));
    });
    return box;
}

// The size of the box with an outside border in y and z. The border in x is part of each row.
glm::ivec3 bordered(const Box& box) { return glm::max(box.most - box.least + 1, glm::ivec3(0)) + glm::ivec3(0, 2, 2); }

} // namespace

VoxelSet::VoxelSet(const SparseMask& mask, const glm::dvec3& spacing, LargeAllocator<std::byte> memory)
    : spacing_(spacing), bits_(glm::ivec3(0)), memory_(std::move(memory)) {
    const Box box = box_of(mask);
    const glm::ivec3 size = bordered(box);
    origin_ = box.least - glm::ivec3(0, 1, 1);
    SparseMask::Builder builder(size);
    const SparseMask shape(glm::ivec3(size.x, size.y, 0));
    const auto height = static_cast<std::size_t>(mask.size().y);
    const std::size_t skipped = static_cast<std::size_t>(box.least.x) / 64,
                      shift = static_cast<std::size_t>(box.least.x) % 64;
    mask.for_words([&](std::size_t w, std::uint64_t word) {
        const std::size_t row = w / mask.row_words(), column = w % mask.row_words();
        const std::size_t to =
            shape.first_of(static_cast<int>(row % height) - origin_.y, static_cast<int>(row / height) - origin_.z) +
            column - skipped;
        if (shift != 0) builder.add(to - 1, word << (64 - shift));
        builder.add(to, word >> shift);
    });
    bits_ = std::move(builder).finish();
    ranks_.resize(bits_.places());
    for (std::size_t place = 0; place < ranks_.size(); ++place) {
        ranks_[place] = count_;
        count_ += count_bits(bits_.at_place(place));
    }
}

double VoxelSet::step_mm(int bit) const {
    return glm::length(spacing_ * glm::dvec3(bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1));
}

} // namespace ramus::volume
