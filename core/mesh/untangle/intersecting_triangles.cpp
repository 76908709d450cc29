#include "core/mesh/untangle/intersecting_triangles.h"

#include "core/base/lists_by_thread.h"
#include "core/mesh/untangle/exact_triangles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>

namespace ramus::mesh {

namespace {

constexpr std::size_t kGroup = TriangleBoxes::kGroup;
constexpr std::size_t kBlock = EightBoxes::kCount * kGroup; // triangles

constexpr bool is_compared(Compared one) { return one != Compared::kNot; }

bool share_corner(const glm::uvec3& s, const glm::uvec3& t) {
    bool shared = false; // no test depends on another
    for (int n = 0; n < 3; ++n) shared |= s[n] == t.x, shared |= s[n] == t.y, shared |= s[n] == t.z;
    return shared;
}

// The compared triangles of a block of consecutive triangles, which have nearly the same triangles around them.
class ComparedBlock {
public:
    ComparedBlock(const TriangleBoxes& boxes, std::span<const Compared> compared, std::size_t block)
        : begin_(kBlock * block) {
        for (std::size_t n = begin_; n < std::min(begin_ + kBlock, compared.size()); ++n)
            if (is_compared(compared[n])) add(boxes, n), with_all_ |= compared[n] == Compared::kWithAll;
        for (std::size_t group = 0; group < EightBoxes::kCount; ++group) groups_.set(group, boxes_[group].around());
    }
    [[nodiscard]] std::size_t begin() const { return begin_; }
    // Whether any of them is compared with all triangles.
    [[nodiscard]] bool with_all() const { return with_all_; }
    [[nodiscard]] TriangleBox around() const { return groups_.around(); }
    [[nodiscard]] const exact::Plane& plane(std::size_t triangle) const { return planes_[triangle - begin_]; }
    [[nodiscard]] bool may_meet(const TriangleBox& box) const { return groups_.meeting(box) != 0; }
    // Calls call(triangle) for each compared triangle of the block whose box intersects `box`.
    template <class Call> void for_each_meeting(const TriangleBox& box, const Call& call) const {
        for (unsigned groups = groups_.meeting(box); groups != 0; groups &= groups - 1) {
            const auto group = static_cast<std::size_t>(std::countr_zero(groups));
            for (unsigned bits = boxes_[group].meeting(box); bits != 0; bits &= bits - 1)
                call(static_cast<std::uint32_t>(begin_ + kGroup * group) +
                     static_cast<std::uint32_t>(std::countr_zero(bits)));
        }
    }

private:
    void add(const TriangleBoxes& boxes, std::size_t n) {
        const glm::uvec3& t = boxes.triangles()[n];
        const std::span<const glm::vec3> at = boxes.positions();
        boxes_[(n - begin_) / kGroup].set(n % kGroup, box_of(at, t));
        planes_[n - begin_] = {at[t.x], at[t.y], at[t.z]};
    }

    std::size_t begin_;
    bool with_all_ = false;
    std::array<EightBoxes, EightBoxes::kCount> boxes_; // by group; empty boxes for triangles that are not compared
    EightBoxes groups_;
    std::array<exact::Plane, kBlock> planes_; // of compared triangles
};

} // namespace

IntersectingTriangles intersecting_triangles(const TriangleBoxes& boxes, std::span<const Compared> compared,
                                             const IntersectionLimits& limits, Job& job) {
    const std::span<const glm::uvec3> triangles = boxes.triangles();
    const std::size_t most_looks = limits.looks > std::numeric_limits<std::size_t>::max() / kBlock
                                       ? std::numeric_limits<std::size_t>::max()
                                       : limits.looks * kBlock;
    ListsByThread<TrianglePair> found; // each thread's as many as are listed and one more
    std::atomic<std::size_t> pairs{0};
    std::atomic<bool> all{true};
    const auto compare = [&](std::size_t n) {
        const auto its = compared.subspan(kBlock * n, std::min(kBlock, compared.size() - kBlock * n));
        if (std::ranges::none_of(its, is_compared)) return; // most often
        const ComparedBlock block(boxes, compared, n);
        if (job.cancelled()) return;
        std::size_t its_looks = 0, its_pairs = 0;
        std::vector<TrianglePair>& list = found.local();
        const auto look = [&](std::uint32_t other) {
            if (!is_compared(compared[other])) {
                if (!block.with_all()) return;
            } else if (other < block.begin()) {
                return; // the block of `other` finds these pairs
            }
            block.for_each_meeting(boxes.box(other), [&](std::uint32_t one) {
                if (one == other || (is_compared(compared[other]) && other < one)) return; // each pair once
                if (compared[one] != Compared::kWithAll && compared[other] != Compared::kWithAll &&
                    (!is_compared(compared[other]) || share_corner(triangles[one], triangles[other])))
                    return;
                if (++its_looks > most_looks) return;
                if (surely_beside(boxes.positions(), block.plane(one), triangles[one], triangles[other])) return;
                if (!triangles_meet(boxes.positions(), triangles[one], triangles[other])) return;
                ++its_pairs;
                if (list.size() <= limits.pairs) list.push_back({std::min(one, other), std::max(one, other)});
            });
        };
        boxes.for_each_group_in(block.around(), [&](std::size_t group, const TriangleBox& around) {
            if (its_looks <= most_looks && block.may_meet(around)) boxes.for_each_of(group, look);
        });
        pairs += its_pairs;
        if (its_looks > most_looks) all = false;
    };
    // Small ranges balance the load, since all compared triangles lie in a few places.
    constexpr std::size_t kAtATime = 64;
    const tbb::blocked_range<std::size_t> blocks(0, (compared.size() + kBlock - 1) / kBlock, kAtATime);
    tbb::parallel_for(
        blocks,
        [&](const auto& range) {
            for (std::size_t n = range.begin(); n < range.end(); ++n) compare(n);
        },
        tbb::simple_partitioner());
    if (job.cancelled()) return {{}, 0, false};
    IntersectingTriangles meeting{{}, pairs, all};
    if (meeting.count <= limits.pairs) meeting.pairs = found.sorted();
    return meeting;
}

} // namespace ramus::mesh
