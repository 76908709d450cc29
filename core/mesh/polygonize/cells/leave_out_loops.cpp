#include "core/mesh/polygonize/cells/leave_out_loops.h"

#include <algorithm>
#include <vector>

namespace ramus::mesh::bricks {

namespace {

constexpr std::uint16_t kLeftOut = 0xFFFF;

// The loops and arcs of one brick.
class BrickLoops {
public:
    BrickLoops(std::span<const LoopPlace> left_out, BrickCells& cells, SubtreeCells& made, std::size_t vertex_count)
        : left_out_(left_out), cells_(cells), made_(made), new_vertex_(vertex_count, 0) {}

    // The new index of each vertex of the brick, or kLeftOut.
    const std::vector<std::uint16_t>& work() {
        for (const LoopPlace& loop : left_out_) mark(loop);
        std::uint16_t next = 0;
        for (std::uint16_t& vertex : new_vertex_) vertex = vertex == kLeftOut ? kLeftOut : next++;
        for (int cell = 0; cell < kCellsPerBrick; ++cell)
            if (cells_.first[static_cast<std::size_t>(cell)] != kNoVertex) rename(cell);
        return new_vertex_;
    }

private:
    [[nodiscard]] CellRecord* record(int cell) {
        if ((cells_.recorded >> cell & 1U) == 0) return nullptr;
        return &made_.records[static_cast<std::size_t>(&record_of(cells_, made_, cell) - made_.records.data())];
    }
    [[nodiscard]] std::span<ArcVertex> arcs(const CellRecord& record) {
        return std::span(made_.arc_vertices).subspan(record.arcs_begin, record.arcs_count);
    }
    void mark(const LoopPlace& loop) {
        const std::uint16_t first = cells_.first[static_cast<std::size_t>(loop.cell)];
        new_vertex_[std::size_t{first} + loop.loop] = kLeftOut;
        if (const CellRecord* const of = record(loop.cell))
            for (const ArcVertex& arc : arcs(*of))
                if (loop_of(*of, made_, arc.edge) == loop.loop) new_vertex_[arc.vertex] = kLeftOut;
    }
    void rename(int cell) {
        std::uint16_t& first = cells_.first[static_cast<std::size_t>(cell)];
        CellRecord* const of = record(cell);
        if (of == nullptr) {
            first = new_vertex_[first];
            return;
        }
        // Loops are numbered from the first one on.
        const std::uint16_t before = first;
        first = kNoVertex;
        const auto each_loop = [&](const auto& change) {
            for (std::uint8_t& loop : of->loop_of) change(loop);
            if (of->walls == kNoWalls) return;
            for (std::uint8_t& loop : made_.upper_loops[of->walls]) change(loop);
        };
        each_loop([&](std::uint8_t loop) {
            if (loop != kNoLoop) first = std::min(first, new_vertex_[std::size_t{before} + loop]);
        });
        each_loop([&](std::uint8_t& loop) {
            if (loop == kNoLoop) return;
            const std::uint16_t now = new_vertex_[std::size_t{before} + loop];
            loop = now == kLeftOut ? kNoLoop : static_cast<std::uint8_t>(now - first);
        });
        for (ArcVertex& arc : arcs(*of)) arc.vertex = new_vertex_[arc.vertex]; // no edge leads to those left out
    }

    std::span<const LoopPlace> left_out_;
    BrickCells& cells_;
    SubtreeCells& made_;
    std::vector<std::uint16_t> new_vertex_;
};

} // namespace

void leave_out_loops(const Subtree& subtree, std::span<const LoopPlace> loops, ChunkedArray<BrickCells>& cells,
                     SubtreeCells& made, SurfaceVertices& vertices) {
    std::vector<LoopPlace> sorted(loops.begin(), loops.end());
    std::ranges::sort(sorted, {}, &LoopPlace::brick);
    std::size_t kept = made.first_vertex; // the end of what stays
    std::uint32_t gone = 0;
    // Vertices are in the order in which bricks were filled: backward.
    std::uint32_t b = subtree.first_brick + subtree.brick_count;
    while (b > subtree.first_brick) {
        BrickCells& brick = cells[--b];
        if (!brick.crossed) continue;
        std::uint32_t next = b;
        while (next > subtree.first_brick && !cells[next - 1].crossed) --next;
        const std::size_t first = made.first_vertex + brick.first_vertex;
        const std::size_t end =
            next > subtree.first_brick ? made.first_vertex + cells[next - 1].first_vertex : vertices.count;
        brick.first_vertex -= gone;
        const auto begin = std::ranges::lower_bound(sorted, b, {}, &LoopPlace::brick);
        const auto of_brick = std::span(begin, std::ranges::upper_bound(sorted, b, {}, &LoopPlace::brick));
        if (of_brick.empty()) {
            if (kept != first) copy_vertices(vertices, first, vertices, kept, end - first);
            kept += end - first;
            continue;
        }
        BrickLoops left(of_brick, brick, made, end - first);
        const std::vector<std::uint16_t>& where = left.work();
        for (std::size_t n = 0; n < where.size(); ++n)
            if (where[n] != kLeftOut) copy_vertices(vertices, first + n, vertices, kept++, 1);
        gone = static_cast<std::uint32_t>(end - kept);
    }
    vertices.count = kept;
}

} // namespace ramus::mesh::bricks
