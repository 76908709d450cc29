#include "core/mesh/polygonize/cells/leave_out_circuits.h"

#include <algorithm>
#include <vector>

namespace ramus::mesh::bricks {

namespace {

constexpr std::uint16_t kLeftOut = 0xFFFF;

// The circuits and arcs of one brick.
class BrickCircuits {
public:
    BrickCircuits(std::span<const CircuitPlace> left_out, BrickCells& cells, SubtreeCells& made,
                  std::size_t vertex_count)
        : left_out_(left_out), cells_(cells), made_(made), new_vertex_(vertex_count, 0) {}

    // The new index of each vertex of the brick, or kLeftOut.
    const std::vector<std::uint16_t>& work() {
        for (const CircuitPlace& circuit : left_out_) mark(circuit);
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
    void mark(const CircuitPlace& circuit) {
        const std::uint16_t first = cells_.first[static_cast<std::size_t>(circuit.cell)];
        new_vertex_[std::size_t{first} + circuit.number] = kLeftOut;
        if (const CellRecord* const of = record(circuit.cell))
            for (const ArcVertex& arc : arcs(*of))
                if (circuit_of(*of, made_, arc.edge) == circuit.number) new_vertex_[arc.vertex] = kLeftOut;
    }
    void rename(int cell) {
        std::uint16_t& first = cells_.first[static_cast<std::size_t>(cell)];
        CellRecord* const of = record(cell);
        if (of == nullptr) {
            first = new_vertex_[first];
            return;
        }
        // Circuits are numbered from the first one on.
        const std::uint16_t before = first;
        first = kNoVertex;
        const auto each_circuit = [&](const auto& change) {
            for (std::uint8_t& circuit : of->circuit_of) change(circuit);
            if (of->walls == kNoWalls) return;
            for (std::uint8_t& circuit : made_.upper_circuits[of->walls]) change(circuit);
        };
        each_circuit([&](std::uint8_t circuit) {
            if (circuit != kNoCircuit) first = std::min(first, new_vertex_[std::size_t{before} + circuit]);
        });
        each_circuit([&](std::uint8_t& circuit) {
            if (circuit == kNoCircuit) return;
            const std::uint16_t now = new_vertex_[std::size_t{before} + circuit];
            circuit = now == kLeftOut ? kNoCircuit : static_cast<std::uint8_t>(now - first);
        });
        for (ArcVertex& arc : arcs(*of)) arc.vertex = new_vertex_[arc.vertex]; // no edge leads to those left out
    }

    std::span<const CircuitPlace> left_out_;
    BrickCells& cells_;
    SubtreeCells& made_;
    std::vector<std::uint16_t> new_vertex_;
};

} // namespace

void leave_out_circuits(const Subtree& subtree, std::span<const CircuitPlace> circuits, ChunkedArray<BrickCells>& cells,
                        SubtreeCells& made, SurfaceVertices& vertices) {
    std::vector<CircuitPlace> sorted(circuits.begin(), circuits.end());
    std::ranges::sort(sorted, {}, &CircuitPlace::brick);
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
        const auto begin = std::ranges::lower_bound(sorted, b, {}, &CircuitPlace::brick);
        const auto of_brick = std::span(begin, std::ranges::upper_bound(sorted, b, {}, &CircuitPlace::brick));
        if (of_brick.empty()) {
            if (kept != first) copy_vertices(vertices, first, vertices, kept, end - first);
            kept += end - first;
            continue;
        }
        BrickCircuits left(of_brick, brick, made, end - first);
        const std::vector<std::uint16_t>& where = left.work();
        for (std::size_t n = 0; n < where.size(); ++n)
            if (where[n] != kLeftOut) copy_vertices(vertices, first + n, vertices, kept++, 1);
        gone = static_cast<std::uint32_t>(end - kept);
    }
    vertices.count = kept;
}

} // namespace ramus::mesh::bricks
