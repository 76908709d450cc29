#include "core/organ/surfaces/relax_net.h"

#include "core/base/grouped.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::organ::surfaces {

namespace {

// Sweeps, and weight of the start. Tuned on ellipsoids with slices four times as thick as their pixels are wide: with
// half of the sweeps normals are off by half as much again; the weight keeps shapes of 30 voxels and more. A start from
// the smallest surface in the cells is worse, since that has kinks.
constexpr int kSweeps = 150;
// Sweeps after which the surface is smooth enough to have normals. Later, vertices at junctions on the organ's surface
// move freely within it, so that its grid of vertices does not notch the line.
constexpr int kFree = 50;
constexpr float kStartWeight = 1e-4F;
// Further weight of the start at a label of one voxel. It falls with the fourth power of the label's radius, as the
// bending does.
constexpr float kSmallWeight = 0.3F;

template <class Each> void for_vertices(std::size_t count, const Each& each) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
        for (std::size_t n = range.begin(); n < range.end(); ++n) each(n);
    });
}

// Which differences count: for each row the vertex, and the neighbours whose mean it is compared with.
struct Rows {
    std::vector<std::uint32_t> vertex;
    Grouped<std::uint32_t> neighbours; // by row
    Grouped<std::uint32_t> rows;       // by vertex: those in which it is a neighbour
    // By vertex: the row on the organ's surface, for vertices at junctions; kNone: there is none.
    std::vector<std::uint32_t> outer_row;
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
};

Rows rows_of(const LabelNet& net) {
    const std::size_t count = net.corners.size();
    std::vector<std::uint8_t> junctions(count, 0), outer(count, 0);
    for (const Arc& arc : net.arcs)
        for (const std::uint32_t v : {arc.from, arc.to}) {
            junctions[v] = static_cast<std::uint8_t>(junctions[v] + (arc.junction ? 1 : 0));
            outer[v] = static_cast<std::uint8_t>(outer[v] + (arc.outer ? 1 : 0));
        }
    Rows rows;
    rows.outer_row.assign(count, Rows::kNone);
    for (std::uint32_t v = 0; v < count; ++v) rows.vertex.push_back(v);
    for (std::uint32_t v = 0; v < count; ++v)
        if (junctions[v] > 0 && outer[v] > 2) {
            rows.outer_row[v] = static_cast<std::uint32_t>(rows.vertex.size());
            rows.vertex.push_back(v);
        }
    const auto for_each = [&](const auto& put) {
        for (const Arc& arc : net.arcs)
            for (const auto& [v, other] : {std::pair(arc.from, arc.to), std::pair(arc.to, arc.from)}) {
                if (junctions[v] == 0 || (junctions[v] == 2 && arc.junction)) put(v, other);
                if (arc.outer && rows.outer_row[v] != Rows::kNone) put(rows.outer_row[v], other);
            }
    };
    rows.neighbours = Grouped<std::uint32_t>(rows.vertex.size(), for_each);
    rows.rows = Grouped<std::uint32_t>(count, [&](const auto& put) {
        for (std::uint32_t row = 0; row < rows.vertex.size(); ++row)
            for (const std::uint32_t v : rows.neighbours.of(row)) put(v, row);
    });
    return rows;
}

class Relaxation {
public:
    Relaxation(const LabelNet& net, std::span<const std::uint32_t> least_voxels)
        : net_(net), rows_(rows_of(net)), weights_(net.corners.size()), steps_(net.corners.size()),
          differences_(rows_.vertex.size()) {
        for_vertices(net.corners.size(), [&](std::size_t v) {
            const float voxels = std::max(1.0F, static_cast<float>(least_voxels[v]));
            weights_[v] = kStartWeight + kSmallWeight * std::pow(voxels, -4.0F / 3.0F);
            // The sum of the absolute values of a row of the energy's matrix bounds its eigenvalues.
            float bound = weights_[v];
            if (!rows_.neighbours.of(v).empty()) bound += 2.0F;
            if (rows_.outer_row[v] != Rows::kNone) bound += 2.0F;
            for (const std::uint32_t row : rows_.rows.of(v)) bound += 2.0F * share(row);
            steps_[v] = 1.0F / bound;
        });
    }

    LargeArray<glm::vec3> run(const JobRange& job) {
        LargeArray<glm::vec3> now(net_.starts.begin(), net_.starts.end());
        LargeArray<glm::vec3> ahead = now;
        float momentum = 1.0F;
        for (int sweep = 0; sweep < kSweeps && !job.cancelled(); ++sweep) {
            if (sweep == kFree) find_normals(now);
            const float next = 0.5F * (1.0F + std::sqrt(1.0F + 4.0F * momentum * momentum));
            const float onward = (momentum - 1.0F) / next;
            momentum = next;
            find_differences(ahead);
            for_vertices(now.size(), [&](std::size_t v) {
                const glm::vec3 place = glm::clamp(ahead[v] - steps_[v] * slope(ahead[v], v),
                                                   net_.corners[v] - kMostMove, net_.corners[v] + kMostMove);
                ahead[v] = place + onward * (place - now[v]);
                now[v] = place;
            });
            job.report(static_cast<float>(sweep + 1) / static_cast<float>(kSweeps));
        }
        return now;
    }

private:
    void find_differences(const LargeArray<glm::vec3>& places) {
        for_vertices(differences_.size(), [&](std::size_t row) {
            glm::vec3 sum(0.0F);
            const glm::vec3 at = places[rows_.vertex[row]];
            for (const std::uint32_t other : rows_.neighbours.of(row)) sum += places[other] - at;
            differences_[row] = sum * share(row);
            if (row >= places.size() && !normals_.empty()) {
                const glm::vec3& normal = normals_[row - places.size()];
                differences_[row] = glm::dot(normal, differences_[row]) * normal;
            }
        });
    }
    // From now on, rows on the organ's surface count along its normal alone.
    void find_normals(const LargeArray<glm::vec3>& places) {
        normals_.assign(rows_.vertex.size() - places.size(), glm::vec3(0.0F));
        for (std::size_t n = 0; n < net_.quads.size(); ++n) {
            if (net_.quad_sides[n].outside != kOutside) continue;
            const auto& [a, b, c, d] = net_.quads[n];
            const glm::vec3 normal = glm::cross(places[c] - places[a], places[d] - places[b]);
            for (const std::uint32_t v : net_.quads[n])
                if (rows_.outer_row[v] != Rows::kNone) normals_[rows_.outer_row[v] - places.size()] += normal;
        }
        for (glm::vec3& normal : normals_) normal = glm::length(normal) > 0.0F ? glm::normalize(normal) : normal;
    }
    // Of each neighbour in the mean of a row.
    [[nodiscard]] float share(std::size_t row) const {
        const std::size_t around = rows_.neighbours.of(row).size();
        return around == 0 ? 0.0F : 1.0F / static_cast<float>(around);
    }
    [[nodiscard]] glm::vec3 slope(const glm::vec3& at, std::size_t v) const {
        glm::vec3 sum = weights_[v] * (at - net_.starts[v]) - differences_[v];
        if (rows_.outer_row[v] != Rows::kNone) sum -= differences_[rows_.outer_row[v]];
        for (const std::uint32_t row : rows_.rows.of(v)) sum += share(row) * differences_[row];
        return sum;
    }

    const LabelNet& net_;
    Rows rows_;
    std::vector<float> weights_, steps_; // by vertex
    LargeArray<glm::vec3> differences_;  // by row: mean of the neighbours, less the vertex
    std::vector<glm::vec3> normals_;     // of rows on the organ's surface; empty: not yet known
};

} // namespace

LargeArray<glm::vec3> relaxed(const LabelNet& net, std::span<const std::uint32_t> least_voxels, const JobRange& job) {
    LargeArray<glm::vec3> places = Relaxation(net, least_voxels).run(job);
    for (const Middle& middle : net.middles)
        places[middle.vertex] =
            0.5F * (places[middle.from] + places[middle.to]) + net.starts[middle.vertex] - net.corners[middle.vertex];
    return places;
}

} // namespace ramus::organ::surfaces
