#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mesh/polygonize/octree/brick_neighbours.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/mesh/polygonize/octree/neighbours.h"

#include <bit>
#include <cstring>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::mesh::bricks::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE void describe(const EntriesAround& around, Neighbourhood& described) {
    const hn::CappedTag<std::int32_t, 16> d;
    constexpr std::size_t kPlaces = 32;
    static_assert(sizeof(around.at) == kPlaces * sizeof(std::int32_t));
    // As signed integers: nodes < full < empty < bricks.
    const auto full = hn::Set(d, std::bit_cast<std::int32_t>(OctreeEntry::full()));
    HWY_ALIGN std::array<std::int32_t, kPlaces> codes;
    std::memcpy(codes.data(), around.at.data(), sizeof(codes));
    std::uint64_t bricks = 0;
    std::uint64_t nodes = 0;
    std::uint64_t filled = 0;
    for (std::size_t n = 0; n < kPlaces; n += hn::Lanes(d)) {
        const auto code = hn::Load(d, codes.data() + n);
        const auto bits = [&](auto mask) {
            HWY_ALIGN std::uint8_t bytes[8] = {};
            hn::StoreMaskBits(d, mask, bytes);
            const std::uint64_t word = bytes[0] | static_cast<std::uint64_t>(bytes[1]) << 8;
            return (word & ((std::uint64_t{1} << hn::Lanes(d)) - 1)) << n;
        };
        bricks |= bits(hn::Gt(code, hn::Set(d, -1)));
        nodes |= bits(hn::Lt(code, full));
        filled |= bits(hn::Eq(code, full));
    }
    constexpr std::uint32_t kAll = (std::uint32_t{1} << kDirections) - 1;
    std::memcpy(described.brick.data(), codes.data(), sizeof(described.brick));
    described.same = static_cast<std::uint32_t>(bricks) & kAll & ~around.larger;
    described.coarser = static_cast<std::uint32_t>(bricks) & around.larger;
    described.finer = static_cast<std::uint32_t>(nodes) & kAll;
    described.full = static_cast<std::uint32_t>(filled) & kAll;
}

void describe_below(const Octree& octree, const EntriesAround& around, ChunkedArray<Neighbourhood>& found) {
    const OctreeEntry self = around.at[kSelf];
    if (self.is_brick()) describe(around, found[self.index()]);
    if (!self.is_node()) return;
    const EntriesAroundChildren children = entries_around_children(octree, around);
    for (std::size_t child = 0; child < field::kChildren; ++child)
        if (!octree.nodes[self.index()][child].is_empty())
            describe_below(octree, entries_around_child(children, child), found);
}

void describe_brick(const EntriesAround& around, Neighbourhood& described) { describe(around, described); }

} // namespace ramus::mesh::bricks::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::mesh::bricks {

HWY_EXPORT(describe_below);
HWY_EXPORT(describe_brick);

namespace {

// Descends from the top node to the entry (a brick or an empty cube) that contains a cube of one unit. Calls
// enter(child) at each step; returns the entry.
template <class Enter> OctreeEntry descend(const Octree& octree, const glm::ivec3& unit, const Enter& enter) {
    OctreeEntry entry = OctreeEntry::node(octree.upper[0].node);
    for (int level = octree.top_level - 1; entry.is_node(); --level) {
        const glm::ivec3 half = unit / brick_units(level) & 1;
        const auto child = static_cast<std::size_t>(half.x | half.y << 1 | half.z << 2);
        entry = octree.nodes[entry.index()][child];
        enter(child);
    }
    return entry;
}

} // namespace

Neighbourhood neighbourhood_of(const Octree& octree, std::uint32_t brick) {
    EntriesAround around;
    around.at[kSelf] = OctreeEntry::node(octree.upper[0].node);
    (void)descend(octree, octree.bricks[brick].corner, [&](std::size_t child) {
        around = entries_around_child(entries_around_children(octree, around), child);
    });
    Neighbourhood described;
    HWY_DYNAMIC_DISPATCH(describe_brick)(around, described);
    return described;
}

std::uint32_t brick_at(const Octree& octree, const glm::ivec3& unit) {
    const int size = brick_units(octree.top_level);
    for (int axis = 0; axis < 3; ++axis)
        if (unit[axis] < 0 || unit[axis] >= size) return kNoBrick;
    const OctreeEntry entry = descend(octree, unit, [](std::size_t) {});
    return entry.is_brick() ? entry.index() : kNoBrick;
}

void describe_bricks(const Octree& octree, const EntriesAround& around, ChunkedArray<Neighbourhood>& found) {
    HWY_DYNAMIC_DISPATCH(describe_below)(octree, around, found);
}

} // namespace ramus::mesh::bricks
#endif
