#include "core/mesh/polygonize/cells/brick_grid.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace ramus::mesh::bricks {

namespace {

// Extracts bits of 4 x 4 x 4 bits, x + 4 y + 16 z: those with x = 0 as y + 4 z, and those with y = 0 as x + 4 z.
constexpr unsigned every_fourth(std::uint64_t b) {
    b &= 0x1111111111111111U;
    b = (b | b >> 3) & 0x0303030303030303U;
    b = (b | b >> 6) & 0x000F000F000F000FU;
    b = (b | b >> 12) & 0x000000FF000000FFU;
    return static_cast<unsigned>((b | b >> 24) & 0xFFFFU);
}
constexpr unsigned first_rows(std::uint64_t b) {
    b &= 0x000F000F000F000FU;
    b = (b | b >> 12) & 0x000000FF000000FFU;
    return static_cast<unsigned>((b | b >> 24) & 0xFFFFU);
}

} // namespace

void BrickGrid::begin(std::uint32_t first_brick, std::uint32_t brick_count) {
    first_brick_ = first_brick;
    brick_count_ = brick_count;
    if (own_.size() < brick_count) own_.resize(brick_count);
}

void BrickGrid::sample(std::uint32_t brick, const Neighbourhood& neighbours, field::BrickField& field,
                       SampleCounts& counts) {
    index_ = brick - first_brick_;
    neighbours_ = &neighbours;
    sample(field::kOwnGroups, field, counts);
    OwnSamples& own = own_[index_];
    std::memcpy(own.value.data(), samples_.value.data(), sizeof(own.value));
    std::memcpy(&own.inside, samples_.inside.data(), sizeof(own.inside));
    add_upper_sides(field, counts);
    add_upper_edges(field, counts);
    assemble_bits();
}

void BrickGrid::sample(unsigned groups, field::BrickField& field, SampleCounts& counts) {
    if (groups == 0) return;
    counts.evaluations += field.sample_groups(groups, samples_);
    counts.samples += field::kGroupPoints * static_cast<std::uint64_t>(std::popcount(groups));
}

BrickGrid::UpperPart BrickGrid::upper_part(int x, int y, int z) const {
    const int direction = direction_index(x, y, z);
    UpperPart part;
    switch (neighbours_->kind(direction)) {
    case Neighbour::kSame: {
        const std::uint32_t index = neighbours_->brick[static_cast<std::size_t>(direction)] - first_brick_;
        if (index < brick_count_) part.neighbour = &own_[index]; // of the same subtree
        break;
    }
    case Neighbour::kAbsent:
        part.known = true;
        part.full = (neighbours_->full >> direction & 1U) != 0;
        break;
    default:
        break;
    }
    return part;
}

// The points on the upper sides: groups 4 to 6. Samples a group unless its values are known, or its side of the surface
// is known and all adjacent points are on the same side.
void BrickGrid::add_upper_sides(field::BrickField& field, SampleCounts& counts) {
    const std::uint64_t own = own_[index_].inside;
    unsigned requested = 0;
    const auto add = [&](std::size_t group, const UpperPart& part, unsigned beside, auto values, auto bits) {
        if (part.neighbour != nullptr) {
            values(part.neighbour->value.data(), samples_.value[group].data());
            samples_.inside[group] = static_cast<std::uint16_t>(bits(part.neighbour->inside));
        } else if (part.known && beside == (part.full ? 0xFFFFU : 0U)) {
            samples_.value[group].fill(part.full ? 1.0F : 0.0F);
            samples_.inside[group] = static_cast<std::uint16_t>(beside);
        } else {
            requested |= 1U << group;
        }
    };
    add(
        4, upper_part(1, 0, 0), every_fourth(own >> 3),
        [](const float* from, float* to) {
            for (int n = 0; n < 16; ++n) to[n] = from[4 * n];
        },
        [](std::uint64_t bits) { return every_fourth(bits); });
    add(
        5, upper_part(0, 1, 0), first_rows(own >> 12),
        [](const float* from, float* to) {
            for (int z = 0; z < 4; ++z) std::copy_n(from + 16 * z, 4, to + 4 * z);
        },
        [](std::uint64_t bits) { return first_rows(bits); });
    add(
        6, upper_part(0, 0, 1), static_cast<unsigned>(own >> 48),
        [](const float* from, float* to) { std::copy_n(from, 16, to); },
        [](std::uint64_t bits) { return static_cast<unsigned>(bits & 0xFFFF); });
    sample(requested, field, counts);
}

// The points on the upper edges and the upper corner: group 7, by the same rule.
void BrickGrid::add_upper_edges(field::BrickField& field, SampleCounts& counts) {
    constexpr std::size_t kGroup = 7;
    const unsigned side_x = samples_.inside[4];
    const unsigned side_y = samples_.inside[5];
    const unsigned side_z = samples_.inside[6];
    auto& values = samples_.value[kGroup];
    unsigned bits = 0;
    bool sampled = false;
    // The part's `count` points, every `stride`-th of the neighbour's own from the first on.
    const auto add = [&](const UpperPart& part, unsigned beside, unsigned first, unsigned count, unsigned stride) {
        const unsigned all = (1U << count) - 1;
        if (part.neighbour != nullptr) {
            for (unsigned n = 0; n < count; ++n) {
                values[first + n] = part.neighbour->value[stride * n];
                bits |= static_cast<unsigned>(part.neighbour->inside >> (stride * n) & 1) << (first + n);
            }
        } else if (part.known && beside == (part.full ? all | all << 4 : 0U)) {
            for (unsigned n = 0; n < count; ++n) values[first + n] = part.full ? 1.0F : 0.0F;
            bits |= (part.full ? all : 0U) << first;
        } else {
            sampled = true;
        }
    };
    add(upper_part(0, 1, 1), (side_y >> 12) | (side_z >> 12) << 4, 0, 4, 1);
    add(upper_part(1, 0, 1), (side_x >> 12) | every_fourth(side_z >> 3) << 4, 4, 4, 4);
    add(upper_part(1, 1, 0), every_fourth(side_x >> 3) | every_fourth(side_y >> 3) << 4, 8, 4, 16);
    if (!sampled) {
        const unsigned ends = bits >> 3 & bits >> 7 & bits >> 11 & 1U; // of the edges, next to the corner
        const unsigned some = (bits >> 3 | bits >> 7 | bits >> 11) & 1U;
        add(upper_part(1, 1, 1), ends == some ? ends | ends << 4 : 2U, 12, 1, 1);
    }
    samples_.inside[kGroup] = static_cast<std::uint16_t>(bits);
    if (sampled) sample(1U << kGroup, field, counts);
}

void BrickGrid::assemble_bits() {
    const std::uint64_t own = own_[index_].inside;
    const unsigned side_x = samples_.inside[4];
    const unsigned side_y = samples_.inside[5];
    const unsigned edges = samples_.inside[7];
    // 4 x 4 bits to rows of 5; 4 bits to a column.
    const auto rows = [](unsigned b) { return (b & 0xFU) | (b & 0xF0U) << 1 | (b & 0xF00U) << 2 | (b & 0xF000U) << 3; };
    const auto column = [](unsigned b) { return ((b & 1U) | (b & 2U) << 4 | (b & 4U) << 8 | (b & 8U) << 12) << 4; };
    GridBits bits =
        GridBits{rows(samples_.inside[6]) | column(edges >> 4 & 0xFU) | (edges & 0xFU) << 20 | (edges >> 12 & 1U) << 24}
        << 100;
    for (unsigned z = 0; z < 4; ++z) {
        const unsigned layer = rows(static_cast<unsigned>(own >> (16 * z) & 0xFFFF)) |
                               column(side_x >> (4 * z) & 0xFU) | (side_y >> (4 * z) & 0xFU) << 20 |
                               (edges >> (8 + z) & 1U) << 24;
        bits |= GridBits{layer} << (25 * z);
    }
    inside_ = bits;
}

void BrickGrid::assemble_values() {
    const float* own = own_[index_].value.data();
    const auto& [g0, g1, g2, g3, side_x, side_y, side_z, edges] = samples_.value;
    for (std::size_t z = 0; z < 4; ++z) {
        float* layer = values_.data() + 25 * z;
        for (std::size_t y = 0; y < 4; ++y) {
            std::memcpy(layer + 5 * y, own + 16 * z + 4 * y, 4 * sizeof(float));
            layer[5 * y + 4] = side_x[4 * z + y];
        }
        std::memcpy(layer + 20, side_y.data() + 4 * z, 4 * sizeof(float));
        layer[24] = edges[8 + z];
    }
    float* top = values_.data() + 100;
    for (std::size_t y = 0; y < 4; ++y) {
        std::memcpy(top + 5 * y, side_z.data() + 4 * y, 4 * sizeof(float));
        top[5 * y + 4] = edges[4 + y];
    }
    std::memcpy(top + 20, edges.data(), 4 * sizeof(float));
    top[24] = edges[12];
}

} // namespace ramus::mesh::bricks
