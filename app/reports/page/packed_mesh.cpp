#include "app/reports/page/packed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <stdexcept>
#include <utility>
#include <zlib.h>

namespace ramus::app {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kUnused = 0xFFFFFFFF; // no vertex, or one without a number

constexpr std::uint8_t kNew = 0, kExplicit = 15; // codes of a vertex; between them: its place among the recent ones
constexpr std::uint8_t kNoEdge = 15;
constexpr std::size_t kRecent = 16, kMostEdges = 15, kMostVertices = 14;

std::uint32_t zigzag(std::int32_t value) {
    return (static_cast<std::uint32_t>(value) << 1U) ^ static_cast<std::uint32_t>(value >> 31);
}

void put_number(Bytes& to, std::uint32_t value) { // seven bits a byte, the low ones first
    for (; value > 127; value >>= 7U) to.push_back(static_cast<std::uint8_t>(value | 128U));
    to.push_back(static_cast<std::uint8_t>(value));
}

// Positions on the grid, in the finest steps.
struct GridPositions {
    std::vector<glm::ivec3> at; // by vertex
    Bytes shifts;               // by group
};

// Codes triangles; the decoder repeats what happens to the lists of recent edges and vertices.
class TriangleCoder {
public:
    // `numbers`: by vertex; kUnused where it is not known. With `grid` new vertices are numbered and get corrections;
    // without it they have numbers, which are written.
    TriangleCoder(std::vector<std::uint32_t>& numbers, const GridPositions* grid)
        : numbers_(numbers), grid_(grid), seen_(grid == nullptr ? numbers.size() : 0, 0) {}

    void set_group(std::size_t group) {
        if (grid_ != nullptr) shift_ = grid_->shifts[group];
    }

    void put(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        for (std::size_t back = 0; back < kMostEdges; ++back) {
            const Edge& edge = edges_[(next_edge_ - 1 - back) % kRecent];
            for (int turn = 0; turn < 3; ++turn, std::swap(a, b), std::swap(b, c))
                if (edge.to == a && edge.from == b) return put_across(edge, static_cast<std::uint8_t>(back), c);
        }
        put_alone(a, b, c);
    }

    Bytes gates, extras;
    std::vector<glm::ivec3> corrections;

private:
    struct Edge {
        std::uint32_t from = kUnused, to = kUnused, opposite = kUnused;
    };

    void put_across(Edge edge, std::uint8_t back, std::uint32_t c) {
        const std::uint8_t code = code_of(c, &edge);
        gates.push_back(static_cast<std::uint8_t>(back << 4U | code));
        put_edge({edge.from, c, edge.to});
        put_edge({c, edge.to, edge.from});
    }

    void put_alone(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::uint8_t first = code_of(a, nullptr), second = code_of(b, nullptr), third = code_of(c, nullptr);
        gates.push_back(static_cast<std::uint8_t>(kNoEdge << 4U | first));
        gates.push_back(static_cast<std::uint8_t>(second << 4U | third));
        put_edge({a, b, c});
        put_edge({b, c, a});
        put_edge({c, a, b});
    }

    std::uint8_t code_of(std::uint32_t vertex, const Edge* across) {
        if (grid_ != nullptr ? numbers_[vertex] == kUnused : seen_[vertex] == 0) {
            put_new(vertex, across);
            recent_[next_recent_++ % kRecent] = vertex;
            return kNew;
        }
        for (std::size_t back = 0; back < kMostVertices; ++back)
            if (recent_[(next_recent_ - 1 - back) % kRecent] == vertex) return static_cast<std::uint8_t>(1 + back);
        put_difference(numbers_[vertex], last_explicit_);
        recent_[next_recent_++ % kRecent] = vertex;
        return kExplicit;
    }

    void put_new(std::uint32_t vertex, const Edge* across) {
        if (grid_ == nullptr) {
            seen_[vertex] = 1;
            return put_difference(numbers_[vertex], last_new_);
        }
        const glm::ivec3& at = grid_->at[vertex];
        const glm::ivec3 predicted =
            across != nullptr ? grid_->at[across->from] + grid_->at[across->to] - grid_->at[across->opposite] : last_;
        glm::ivec3 correction{};
        const std::int32_t half = (1 << shift_) >> 1;
        for (int axis = 0; axis < 3; ++axis)
            correction[axis] = (at[axis] >> shift_) - ((predicted[axis] + half) >> shift_);
        corrections.push_back(correction);
        numbers_[vertex] = numbered_++;
        last_ = at;
    }

    void put_difference(std::uint32_t number, std::uint32_t& last) {
        put_number(extras, zigzag(static_cast<std::int32_t>(number - last)));
        last = number;
    }
    void put_edge(const Edge& edge) { edges_[next_edge_++ % kRecent] = edge; }

    std::vector<std::uint32_t>& numbers_;
    const GridPositions* grid_;
    std::vector<std::uint8_t> seen_; // without a grid: by vertex
    std::array<Edge, kRecent> edges_{};
    std::array<std::uint32_t, kRecent> recent_ = [] {
        std::array<std::uint32_t, kRecent> none{};
        none.fill(kUnused);
        return none;
    }();
    std::size_t next_edge_ = kRecent, next_recent_ = kRecent;
    std::uint32_t numbered_ = 0, last_explicit_ = 0, last_new_ = 0;
    glm::ivec3 last_{0};
    int shift_ = 0;
};

struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::max()}, upper{std::numeric_limits<double>::lowest()};
};

Box box_of_used(const BranchSurface& surface) {
    Box box;
    for (const std::uint32_t v : surface.indices) {
        box.lower = glm::min(box.lower, glm::dvec3(surface.positions[v]));
        box.upper = glm::max(box.upper, glm::dvec3(surface.positions[v]));
    }
    return surface.indices.empty() ? Box{glm::dvec3(0.0), glm::dvec3(0.0)} : box;
}

// The wanted step of each group; groups without a radius have the widest.
std::vector<double> wanted_steps(const BranchSurface& surface, const GridChoice& choice) {
    std::vector<double> steps;
    for (const float radius : surface.radius_mm) {
        const double step = choice.share_of_radius * double(radius);
        steps.push_back(step > 0.0 ? std::min(step, choice.most_mm) : choice.most_mm);
    }
    return steps;
}

GridPositions on_grid(const BranchSurface& surface, const GridChoice& choice, PackedMesh& packed) {
    constexpr double kMostSteps = 1 << 22; // across the surface: a correction has three bytes
    const Box box = box_of_used(surface);
    const glm::dvec3 extent = box.upper - box.lower;
    const double longest = std::max({extent.x, extent.y, extent.z, 1e-9});
    const std::vector<double> steps = wanted_steps(surface, choice);
    packed.origin = box.lower;
    packed.step_mm = std::max(*std::ranges::min_element(steps), longest / kMostSteps);
    GridPositions grid{std::vector<glm::ivec3>(surface.positions.size()), {}};
    Bytes done(surface.positions.size(), 0);
    for (std::size_t group = 0; group + 1 < surface.first.size(); ++group) {
        const int shift = std::max(0, static_cast<int>(std::floor(std::log2(steps[group] / packed.step_mm))));
        grid.shifts.push_back(static_cast<std::uint8_t>(shift));
        const double step = std::ldexp(packed.step_mm, shift);
        if (surface.first[group] < surface.first[group + 1])
            packed.widest_step_mm = std::max(packed.widest_step_mm, step);
        for (std::size_t i = 3 * std::size_t{surface.first[group]}; i < 3 * std::size_t{surface.first[group + 1]};
             ++i) {
            const std::uint32_t v = surface.indices[i];
            if (std::exchange(done[v], 1) == 0)
                grid.at[v] =
                    glm::ivec3(glm::round((glm::dvec3(surface.positions[v]) - packed.origin) / step)) * (1 << shift);
        }
    }
    return grid;
}

std::string deflated_counts(const BranchSurface& surface) {
    Bytes bytes;
    for (std::size_t group = 0; group + 1 < surface.first.size(); ++group)
        for (unsigned part = 0; part < 4; ++part)
            bytes.push_back(
                static_cast<std::uint8_t>((surface.first[group + 1] - surface.first[group]) >> (8U * part)));
    return deflated(bytes);
}

void code_all(TriangleCoder& coder, const BranchSurface& surface) {
    for (std::size_t group = 0; group + 1 < surface.first.size(); ++group) {
        coder.set_group(group);
        for (std::size_t i = surface.first[group]; i < surface.first[group + 1]; ++i)
            coder.put(surface.indices[3 * i], surface.indices[3 * i + 1], surface.indices[3 * i + 2]);
    }
}

std::string deflated_corrections(const std::vector<glm::ivec3>& corrections) {
    Bytes planes;
    planes.reserve(9 * corrections.size());
    for (unsigned byte = 0; byte < 3; ++byte)
        for (int axis = 0; axis < 3; ++axis)
            for (const glm::ivec3& one : corrections)
                planes.push_back(static_cast<std::uint8_t>(zigzag(one[axis]) >> (8U * byte)));
    return deflated(planes);
}

} // namespace

PackedMesh packed(const BranchSurface& surface, const BranchSurface& coarse, const GridChoice& choice) {
    PackedMesh made;
    const GridPositions grid = on_grid(surface, choice, made);
    std::vector<std::uint32_t> numbers(surface.positions.size(), kUnused);
    TriangleCoder coder(numbers, &grid);
    code_all(coder, surface);
    made.places = surface.positions;
    for (std::size_t v = 0; v < numbers.size(); ++v)
        if (numbers[v] != kUnused) made.places[v] = glm::vec3(made.origin + made.step_mm * glm::dvec3(grid.at[v]));
    made.vertices = coder.corrections.size();
    made.triangles = surface.triangles();
    made.counts = deflated_counts(surface);
    made.shifts = deflated(grid.shifts);
    made.gates = deflated(coder.gates);
    made.extras = deflated(coder.extras);
    made.corrections = deflated_corrections(coder.corrections);
    if (coarse.indices.empty()) return made;
    TriangleCoder again(numbers, nullptr);
    code_all(again, coarse);
    made.coarse_triangles = coarse.triangles();
    made.coarse_counts = deflated_counts(coarse);
    made.coarse_gates = deflated(again.gates);
    made.coarse_extras = deflated(again.extras);
    return made;
}

std::string deflated(std::span<const std::uint8_t> bytes) {
    uLongf size = compressBound(bytes.size());
    std::string text(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(text.data()), &size, bytes.data(), bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
        throw std::runtime_error("zlib could not compress");
    text.resize(size);
    return text;
}

} // namespace ramus::app
