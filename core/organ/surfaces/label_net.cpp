#include "core/organ/surfaces/label_net.h"

#include "core/organ/surfaces/cell_patches.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::organ::surfaces {

namespace {

// Share of the way from a corner to the middle of a patch at which vertices of one cell start.
constexpr float kApart = 0.2F;

// A cell with polygons. Its corner 0 is voxel `at`.
struct Cell {
    glm::ivec3 at;
    std::uint32_t first = 0;        // its first vertex
    std::uint32_t first_middle = 0; // its first middle
    std::uint8_t crowded = 0;       // bit n: the arcs across its upper side along axis n have middles
    Patches patches;
    Labels labels;
    [[nodiscard]] std::uint32_t vertex(int edge) const {
        return first + static_cast<std::uint32_t>(patches.of_edge[static_cast<std::size_t>(edge)]);
    }
};

constexpr std::array<CellSide, 3> kUpper{cell_side(0, 1), cell_side(1, 1), cell_side(2, 1)};
constexpr std::array<CellSide, 3> kLower{cell_side(0, 0), cell_side(1, 0), cell_side(2, 0)};

struct Box {
    glm::ivec3 least{std::numeric_limits<int>::max()}, most{-1};
};

Box box_of(const Organ& organ) {
    Box box;
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t) {
        box.least = glm::min(box.least, voxel);
        box.most = glm::max(box.most, voxel);
    });
    return box;
}

// The labels of a slice of the box with one more voxel all around, x fastest.
class LabelSlice {
public:
    explicit LabelSlice(const Box& box)
        : box_(box), across_(box.most.x - box.least.x + 3),
          labels_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(box.most.y - box.least.y + 3)) {}
    void fill(const Organ& organ, std::span<const int> labels, int k) {
        std::ranges::fill(labels_, kOutside);
        if (k < box_.least.z || k > box_.most.z) return;
        organ.for_voxels({box_.least.x, box_.least.y, k}, {box_.most.x + 1, box_.most.y + 1, k + 1},
                         [&](const glm::ivec3& voxel, std::size_t number) {
                             row(voxel.y)[voxel.x - box_.least.x + 1] = labels[number];
                         });
    }
    // Begins at voxel least.x - 1.
    [[nodiscard]] int* row(int j) {
        return labels_.data() + static_cast<std::ptrdiff_t>(j - box_.least.y + 1) * across_;
    }

private:
    Box box_;
    int across_;
    std::vector<int> labels_;
};

class Cells {
public:
    Cells(const Organ& organ, std::span<const int> labels, const JobRange& job) : box_(box_of(organ)) {
        const int layers = box_.most.z - box_.least.z + 2;
        std::vector<std::vector<Cell>> found(static_cast<std::size_t>((layers + kLayers - 1) / kLayers));
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t n) {
            const int from = box_.least.z - 1 + static_cast<int>(n) * kLayers;
            if (!job.cancelled()) found[n] = in_layers(organ, labels, from, std::min(from + kLayers, box_.most.z + 1));
        });
        std::size_t count = 0;
        for (const auto& part : found) count += part.size();
        cells_.reserve(count);
        for (auto& part : found) {
            cells_.insert(cells_.end(), part.begin(), part.end());
            part = {};
        }
        find_rows();
    }

    [[nodiscard]] std::vector<Cell>& all() { return cells_; }
    // A cell that must be there.
    [[nodiscard]] const Cell& at(const glm::ivec3& at) const {
        const std::size_t row = row_of(at);
        return *std::lower_bound(cells_.begin() + static_cast<std::ptrdiff_t>(first_[row]),
                                 cells_.begin() + static_cast<std::ptrdiff_t>(first_[row + 1]), at.x,
                                 [](const Cell& cell, int x) { return cell.at.x < x; });
    }

private:
    static constexpr int kLayers = 8; // in one go

    [[nodiscard]] std::size_t row_of(const glm::ivec3& at) const {
        const auto rows = static_cast<std::size_t>(box_.most.y - box_.least.y + 2);
        return static_cast<std::size_t>(at.z - box_.least.z + 1) * rows +
               static_cast<std::size_t>(at.y - box_.least.y + 1);
    }

    void find_rows() {
        first_.assign(row_of({0, box_.most.y, box_.most.z}) + 2, 0);
        for (const Cell& cell : cells_) ++first_[row_of(cell.at) + 1];
        for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    }

    [[nodiscard]] std::vector<Cell> in_layers(const Organ& organ, std::span<const int> labels, int from, int to) const {
        std::vector<Cell> cells;
        LabelSlice below(box_), above(box_);
        above.fill(organ, labels, from);
        for (int k = from; k < to; ++k) {
            std::swap(below, above);
            above.fill(organ, labels, k + 1);
            for (int j = box_.least.y - 1; j <= box_.most.y; ++j)
                add_row(cells, {below.row(j), below.row(j + 1), above.row(j), above.row(j + 1)}, j, k);
        }
        return cells;
    }

    // `rows`: of labels at (j, k), (j + 1, k), (j, k + 1), (j + 1, k + 1).
    void add_row(std::vector<Cell>& cells, const std::array<const int*, 4>& rows, int j, int k) const {
        const auto& [a, b, c, d] = rows;
        const int cells_across = box_.most.x - box_.least.x + 2;
        for (int i = 0; i < cells_across; ++i) {
            if (a[i] == b[i] && a[i] == c[i] && a[i] == d[i] && a[i] == a[i + 1] && a[i] == b[i + 1] &&
                a[i] == c[i + 1] && a[i] == d[i + 1])
                continue;
            const Labels labels{a[i], a[i + 1], b[i], b[i + 1], c[i], c[i + 1], d[i], d[i + 1]};
            cells.push_back({{box_.least.x - 1 + i, j, k}, 0, 0, 0, patches_of(labels), labels});
        }
    }

    Box box_;
    std::vector<Cell> cells_;        // in the order of voxels
    std::vector<std::size_t> first_; // by row of cells, and one past the last
};

class NetBuilder {
public:
    NetBuilder(Cells& cells, bool mirrored) : cells_(cells), mirrored_(mirrored) {}

    // False: too many vertices.
    bool number_vertices() {
        std::uint64_t count = 0;
        for (Cell& cell : cells_.all()) {
            cell.first = static_cast<std::uint32_t>(count);
            count += static_cast<std::uint64_t>(cell.patches.count);
        }
        for_blocks([&](std::size_t, Cell& cell) {
            for (int axis = 0; axis < 3; ++axis)
                if (crowded(cell, axis)) cell.crowded |= static_cast<std::uint8_t>(1U << axis);
        });
        for (Cell& cell : cells_.all()) {
            cell.first_middle = static_cast<std::uint32_t>(count);
            count += static_cast<std::uint64_t>(2 * std::popcount(cell.crowded));
        }
        count_ = count;
        return count < std::numeric_limits<std::int32_t>::max();
    }

    LabelNet build(const JobRange& job) {
        LabelNet net;
        net.corners.resize(count_);
        net.starts.resize(count_);
        std::vector<LabelNet> parts((cells_.all().size() + kBlock - 1) / kBlock);
        for_blocks([&](std::size_t block, const Cell& cell) {
            if (job.cancelled()) return;
            place(cell, net);
            add_arcs(cell, net, parts[block]);
            for (int axis = 0; axis < 3; ++axis) add_polygon(cell, axis, parts[block]);
        });
        const auto append = [](auto& to, auto& from) {
            to.insert(to.end(), from.begin(), from.end());
            from = {};
        };
        for (LabelNet& part : parts) {
            append(net.arcs, part.arcs);
            append(net.middles, part.middles);
            append(net.quads, part.quads);
            append(net.quad_sides, part.quad_sides);
            append(net.triangles, part.triangles);
            append(net.triangle_sides, part.triangle_sides);
        }
        return net;
    }

private:
    static constexpr std::size_t kBlock = 8192; // cells

    template <class Call> void for_blocks(const Call& call) {
        std::vector<Cell>& all = cells_.all();
        tbb::parallel_for(std::size_t{0}, (all.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
            for (std::size_t n = block * kBlock; n < std::min(all.size(), (block + 1) * kBlock); ++n)
                call(block, all[n]);
        });
    }

    [[nodiscard]] const Cell& upper_neighbour(const Cell& cell, int axis) const {
        glm::ivec3 at = cell.at;
        ++at[axis];
        return cells_.at(at);
    }

    // Whether both groups of the upper side along `axis` would connect the same vertices.
    [[nodiscard]] bool crowded(const Cell& cell, int axis) const {
        const CellSide& side = kUpper[static_cast<std::size_t>(axis)];
        const Joints joints = joints_of(cell.labels, side);
        if (joints.groups < 2) return false;
        const auto a = static_cast<std::size_t>(joints.first_of(0)), b = static_cast<std::size_t>(joints.first_of(1));
        if (cell.vertex(side.edges[a]) != cell.vertex(side.edges[b])) return false;
        const Cell& other = upper_neighbour(cell, axis);
        const CellSide& lower = kLower[static_cast<std::size_t>(axis)];
        return other.vertex(lower.edges[a]) == other.vertex(lower.edges[b]);
    }

    // The first middle of a crowded side.
    [[nodiscard]] static std::uint32_t middle_of(const Cell& cell, int axis) {
        const auto before = static_cast<std::uint8_t>(cell.crowded & ((1U << axis) - 1U));
        return cell.first_middle + 2 * static_cast<std::uint32_t>(std::popcount(before));
    }

    // The middle of an edge, from the middle of its cell.
    [[nodiscard]] static glm::vec3 middle_of_edge(int edge) {
        const int axis = edge / 4;
        glm::vec3 at(0.0F);
        at[(axis + 1) % 3] = (edge & 1) != 0 ? 0.5F : -0.5F;
        at[(axis + 2) % 3] = (edge & 2) != 0 ? 0.5F : -0.5F;
        return at;
    }

    static void place(const Cell& cell, LabelNet& net) {
        const glm::vec3 middle = glm::vec3(cell.at) + 0.5F;
        for (int patch = 0; patch < cell.patches.count; ++patch) {
            glm::vec3 sum(0.0F);
            float edges = 0.0F;
            for (int edge = 0; edge < 12; ++edge)
                if (cell.patches.of_edge[static_cast<std::size_t>(edge)] == patch) sum += middle_of_edge(edge), ++edges;
            const std::size_t vertex = cell.first + static_cast<std::size_t>(patch);
            net.corners[vertex] = middle;
            net.starts[vertex] = cell.patches.count == 1 ? middle : middle + kApart / edges * sum;
        }
    }

    void add_arcs(const Cell& cell, LabelNet& net, LabelNet& part) const {
        for (int axis = 0; axis < 3; ++axis) {
            const CellSide& side = kUpper[static_cast<std::size_t>(axis)];
            const Joints joints = joints_of(cell.labels, side);
            if (joints.groups == 0) continue;
            const Cell& other = upper_neighbour(cell, axis);
            for (int group = 0; group < joints.groups; ++group) {
                const auto first = static_cast<std::size_t>(joints.first_of(group));
                const std::uint32_t from = cell.vertex(side.edges[first]);
                const std::uint32_t to = other.vertex(kLower[static_cast<std::size_t>(axis)].edges[first]);
                bool outer = false;
                glm::vec3 sum(0.0F);
                for (std::size_t m = 0; m < 4; ++m) {
                    if (joints.group[m] != group) continue;
                    sum += middle_of_edge(side.edges[m]);
                    for (const std::size_t corner : {m, (m + 1) % 4})
                        outer |= cell.labels[static_cast<std::size_t>(side.corners[corner])] == kOutside;
                }
                part.arcs.push_back({from, to, std::ranges::count(joints.group, group) > 2, outer});
                if ((cell.crowded >> axis & 1) == 0) continue;
                const std::uint32_t middle = middle_of(cell, axis) + static_cast<std::uint32_t>(group);
                part.middles.push_back({middle, from, to});
                glm::vec3 corner = glm::vec3(cell.at) + 0.5F;
                corner[axis] += 0.5F;
                sum[axis] = 0.0F;
                net.corners[middle] = corner;
                net.starts[middle] = corner + 0.5F * kApart * sum;
            }
        }
    }

    // The polygon between the voxel at corner 0 and the next one along `axis`, if their labels differ.
    void add_polygon(const Cell& cell, int axis, LabelNet& part) const {
        const int here = cell.labels[0], there = cell.labels[std::size_t{1} << axis];
        if (here == there) return;
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        glm::ivec3 to_b(0), to_c(0);
        to_b[b] = to_c[c] = 1;
        // Counter-clockwise seen from the upper end of the axis, if that is right-handed.
        const std::array<const Cell*, 4> around{&cell, &cells_.at(cell.at - to_b), &cells_.at(cell.at - to_b - to_c),
                                                &cells_.at(cell.at - to_c)};
        const std::array<int, 4> edges{edge_number(axis, 0, 0), edge_number(axis, 1, 0), edge_number(axis, 1, 1),
                                       edge_number(axis, 0, 1)};
        const std::array<std::size_t, 4> lower{1, 2, 2, 3}; // cell of the arc from corner n to corner n + 1
        std::array<std::uint32_t, 8> ring{};
        std::size_t count = 0, middle = 8;
        for (std::size_t n = 0; n < 4; ++n) {
            ring[count++] = around[n]->vertex(edges[n]);
            const Cell& owner = *around[lower[n]];
            const int normal = n % 2 == 0 ? b : c;
            if ((owner.crowded >> normal & 1) == 0) continue;
            const CellSide& side = kUpper[static_cast<std::size_t>(normal)];
            const auto m =
                static_cast<std::size_t>(std::ranges::find(side.edges, edges[lower[n]]) - side.edges.begin());
            const int group = joints_of(owner.labels, side).group[m];
            middle = count;
            ring[count++] = middle_of(owner, normal) + static_cast<std::uint32_t>(group);
        }
        const bool forward = there == kOutside || (here != kOutside && here < there);
        const Sides sides = forward ? Sides{here, there} : Sides{there, here};
        if (forward == mirrored_) {
            std::reverse(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(count));
            if (middle < 8) middle = count - 1 - middle;
        }
        if (middle == 8) {
            part.quads.push_back({ring[0], ring[1], ring[2], ring[3]});
            part.quad_sides.push_back(sides);
            return;
        }
        // A diagonal between the ends of an arc with a middle would be there twice, one from the middle cannot.
        for (std::size_t n = 1; n + 1 < count; ++n) {
            part.triangles.push_back({ring[middle], ring[(middle + n) % count], ring[(middle + n + 1) % count]});
            part.triangle_sides.push_back(sides);
        }
    }

    Cells& cells_;
    bool mirrored_;
    std::uint64_t count_ = 0; // vertices
};

} // namespace

std::optional<LabelNet> label_net(const Organ& organ, std::span<const int> labels, const JobRange& job) {
    Cells cells(organ, labels, job);
    if (job.cancelled()) return {};
    NetBuilder builder(cells, glm::determinant(glm::dmat3(organ.to_patient())) < 0.0);
    if (!builder.number_vertices()) return {};
    LabelNet net = builder.build(job);
    if (job.cancelled()) return {};
    return net;
}

} // namespace ramus::organ::surfaces
