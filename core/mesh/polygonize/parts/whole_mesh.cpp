#include "core/mesh/polygonize/parts/whole_mesh.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

WholeMesh::WholeMesh(std::span<const SubtreeBatch> schedule, std::span<const SubtreeCounts> counts)
    : places(counts.size()) {
    for (const SubtreeBatch& batch : schedule) {
        for (const std::uint32_t t : batch.fill) places[t].vertices = vertices, vertices += counts[t].vertices;
        for (const std::uint32_t t : batch.join) {
            places[t].added = vertices, vertices += counts[t].added;
            places[t].triangles = triangles, triangles += counts[t].triangles;
        }
    }
}

namespace {

// From indices in the mesh of a part to indices in the whole mesh.
class Renumbering {
public:
    Renumbering(const PartMaking& making, std::span<const SubtreeCounts> counts, std::span<const SubtreePlaces> here,
                std::span<const SubtreePlaces> there) {
        const auto add = [&](std::uint64_t from, std::uint64_t to, std::uint32_t count) {
            if (count > 0) runs_.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)});
        };
        for (std::uint32_t t = 0; t < counts.size(); ++t) {
            if (making.filled()[t] != 0) add(here[t].vertices, there[t].vertices, counts[t].vertices);
            if (making.range().holds(t)) add(here[t].added, there[t].added, counts[t].added);
        }
        std::ranges::sort(runs_, {}, &Run::first);
        // Subtrees that lie side by side in both meshes are one run.
        const auto same = [](const Run& a, const Run& b) { return a.more == b.more; };
        runs_.erase(std::unique(runs_.begin(), runs_.end(), same), runs_.end());
    }

    void renumber(std::span<glm::uvec3> triangles) const {
        Run last{1, 0};
        std::uint32_t end = 0; // of the last run
        for (glm::uvec3& triangle : triangles)
            for (int corner = 0; corner < 3; ++corner) {
                std::uint32_t& index = triangle[corner];
                if (index < last.first || index >= end) {
                    const auto next = std::ranges::upper_bound(runs_, index, {}, &Run::first);
                    last = *std::prev(next);
                    end = next == runs_.end() ? std::numeric_limits<std::uint32_t>::max() : next->first;
                }
                index += last.more;
            }
    }

private:
    struct Run {
        std::uint32_t first, more; // `more` may wrap around
    };
    std::vector<Run> runs_; // by `first`
};

// What one part has of the whole mesh in one batch: ranges in the mesh of the part and in the whole one.
struct Stretch {
    std::uint64_t from = 0, to = 0, count = 0;
};
struct Stretches {
    Stretch vertices, added, triangles;
};

// Calls call(stretches) batch by batch. `here`: null where only the places in the whole mesh are wanted.
template <class Call>
void for_each_stretch(std::span<const SubtreeBatch> schedule, SubtreeRange range, std::span<const SubtreeCounts> counts,
                      const SubtreePlaces* here, std::span<const SubtreePlaces> there, const Call& call) {
    for (const SubtreeBatch& batch : schedule) {
        Stretches found;
        const auto extend = [&](Stretch& stretch, std::uint32_t t, auto member, auto counted) {
            if (stretch.count == 0) stretch = {here != nullptr ? here[t].*member : 0, there[t].*member, 0};
            stretch.count += counts[t].*counted;
        };
        for (const std::uint32_t t : batch.fill)
            if (range.holds(t)) extend(found.vertices, t, &SubtreePlaces::vertices, &SubtreeCounts::vertices);
        for (const std::uint32_t t : batch.join) {
            if (!range.holds(t)) continue;
            extend(found.added, t, &SubtreePlaces::added, &SubtreeCounts::added);
            extend(found.triangles, t, &SubtreePlaces::triangles, &SubtreeCounts::triangles);
        }
        call(found);
    }
}

// Calls call(array, offset, count) for each stretch of each array, in one order for all processes.
template <class Call> void for_each_piece(TriangleMesh& mesh, const Stretches& at, bool there, const Call& call) {
    const auto offset = [&](const Stretch& stretch) { return there ? stretch.to : stretch.from; };
    for (const Stretch* stretch : {&at.vertices, &at.added})
        mesh.for_each_array([&](auto& array) { call(array, offset(*stretch), stretch->count); });
    call(mesh.triangles, offset(at.triangles), at.triangles.count);
}

// The part of `array` as bytes.
template <class T> std::span<std::byte> bytes_of(LargeArray<T>& array, std::uint64_t offset, std::uint64_t count) {
    return std::as_writable_bytes(std::span(array).subspan(offset, count));
}

} // namespace

void renumber_for_whole(PartMaking& making, std::span<const SubtreeCounts> counts, const WholeMesh& whole) {
    const Renumbering renumbering(making, counts, making.batches().places(), whole.places);
    std::span<glm::uvec3> triangles(making.mesh().triangles);
    constexpr std::size_t kAtOnce = 1 << 16;
    tbb::parallel_for(std::size_t{0}, (triangles.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t n) {
        renumbering.renumber(triangles.subspan(n * kAtOnce, std::min(kAtOnce, triangles.size() - n * kAtOnce)));
    });
}

TriangleMesh gather(Team& team, PartMaking& making, std::span<const SubtreeCounts> counts, const WholeMesh& whole,
                    const LargeAllocator<std::byte>& memory) {
    const std::vector<SubtreePlaces> here(making.batches().places().begin(), making.batches().places().end());
    TriangleMesh part = std::move(making.mesh());
    const auto of_part = [&](std::size_t rank, const SubtreePlaces* places, const auto& call) {
        for_each_stretch(making.schedule(), making.ranges()[rank], counts, places, whole.places, call);
    };
    if (!team.leads()) {
        of_part(team.rank(), here.data(), [&](const Stretches& at) {
            for_each_piece(part, at, false, [&](auto& array, std::uint64_t offset, std::uint64_t count) {
                if (count > 0) team.send(bytes_of(array, offset, count));
            });
        });
        return {};
    }
    TriangleMesh mesh(memory);
    mesh.resize_vertices(whole.vertices);
    mesh.triangles.resize(whole.triangles);
    of_part(0, here.data(), [&](const Stretches& at) {
        for (const Stretch* s : {&at.vertices, &at.added}) copy_vertices(part, s->from, mesh, s->to, s->count);
        std::copy_n(part.triangles.data() + at.triangles.from, at.triangles.count,
                    mesh.triangles.data() + at.triangles.to);
    });
    part = {};
    for (std::size_t rank = 1; rank < team.size(); ++rank)
        of_part(rank, nullptr, [&](const Stretches& at) {
            for_each_piece(mesh, at, true, [&](auto& array, std::uint64_t offset, std::uint64_t count) {
                if (count > 0) team.receive(rank, bytes_of(array, offset, count));
            });
        });
    return mesh;
}

} // namespace ramus::mesh::bricks
