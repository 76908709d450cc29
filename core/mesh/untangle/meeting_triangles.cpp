#include "core/mesh/untangle/meeting_triangles.h"

#include "core/base/lists_by_thread.h"
#include "core/mesh/untangle/exact_triangles.h"

#include <algorithm>
#include <atomic>
#include <bit>

namespace ramus::mesh {

// Those of a group are looked at together.
MeetingTriangles meeting_triangles(const TriangleBoxes& boxes, std::span<const std::uint8_t> asked,
                                   const MeetingLimits& limits, Job& job) {
    const std::span<const glm::uvec3> triangles = boxes.triangles();
    const auto count = static_cast<std::size_t>(std::ranges::count_if(asked, [](std::uint8_t a) { return a != 0; }));
    if (count == 0) return {};
    const std::size_t most_looks = limits.looks > std::numeric_limits<std::size_t>::max() / count
                                       ? std::numeric_limits<std::size_t>::max()
                                       : limits.looks * count;
    ListsByThread<TrianglePair> found; // each thread's as many as are listed and one more
    std::atomic<std::size_t> looks{0}, pairs{0};
    constexpr std::size_t kGroup = TriangleBoxes::kGroup;
    tbb::parallel_for(std::size_t{0}, (asked.size() + kGroup - 1) / kGroup, [&](std::size_t group) {
        const std::size_t begin = kGroup * group, end = std::min(begin + kGroup, asked.size());
        EightBoxes its; // around nothing of what is not asked for
        bool any = false;
        for (std::size_t n = begin; n < end; ++n)
            if (asked[n] != 0) its.set(n - begin, boxes.box(n)), any = true;
        if (!any || looks.load(std::memory_order_relaxed) > most_looks || job.cancelled()) return;
        std::size_t its_looks = 0, its_pairs = 0;
        std::vector<TrianglePair>& list = found.local();
        // Those before the group that are asked for find its triangles themselves.
        const auto is_wanted = [&](std::size_t other) { return other >= begin || asked[other] == 0; };
        boxes.for_each_in(its.around(), is_wanted, [&](std::uint32_t other, const TriangleBox& box) {
            for (unsigned bits = its.meeting(box); bits != 0; bits &= bits - 1) {
                const auto n = static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(std::countr_zero(bits));
                if (n == other || (asked[other] != 0 && other < n)) continue; // likewise
                ++its_looks;
                if (!triangles_meet(boxes.positions(), triangles[n], triangles[other])) continue;
                ++its_pairs;
                if (list.size() <= limits.pairs) list.push_back({std::min(n, other), std::max(n, other)});
            }
        });
        looks += its_looks, pairs += its_pairs;
    });
    // Nothing is passed over before there are too many looks: whether there are depends on no thread.
    if (looks > most_looks || job.cancelled()) return {{}, 0, false};
    MeetingTriangles meeting{{}, pairs};
    if (meeting.count <= limits.pairs) meeting.pairs = found.sorted();
    return meeting;
}

} // namespace ramus::mesh
