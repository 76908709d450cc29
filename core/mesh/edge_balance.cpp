#include "core/mesh/edge_balance.h"

#include "core/base/splitmix64.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::mesh {

namespace {

constexpr unsigned kPlaceBits = 10; // of the vertices of a place

// Adds to sums that threads share. Combines consecutive additions to the same sum.
class SharedSums {
public:
    explicit SharedSums(std::span<std::uint64_t> sums) : sums_(sums) {}
    SharedSums(const SharedSums&) = delete;
    SharedSums& operator=(const SharedSums&) = delete;
    ~SharedSums() { put(); }

    void add(std::size_t place, std::uint64_t number) {
        if (place != place_) put(), place_ = place;
        sum_ += number;
    }

private:
    void put() {
        const std::uint64_t sum = std::exchange(sum_, 0);
        if (sum != 0) std::atomic_ref(sums_[place_]).fetch_add(sum, std::memory_order_relaxed);
    }

    std::span<std::uint64_t> sums_;
    std::size_t place_ = 0;
    std::uint64_t sum_ = 0;
};

} // namespace

Result<void> check_balance(const TriangleMesh& mesh) {
    constexpr std::size_t kAtOnce = 4096;
    std::vector<std::uint64_t> sums((mesh.positions.size() >> kPlaceBits) + 1, 0); // by an edge's lower vertex
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), kAtOnce), [&](const auto& range) {
        SharedSums shared(sums);
        for (std::size_t n = range.begin(); n < range.end(); ++n)
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t from = mesh.triangles[n][corner], to = mesh.triangles[n][(corner + 1) % 3];
                const auto [low, high] = std::minmax(from, to);
                const std::uint64_t edge = splitmix64(std::uint64_t{low} << 32 | high);
                shared.add(low >> kPlaceBits, from < to ? edge : 0 - edge);
            }
    });
    const auto first = std::ranges::find_if(sums, [](std::uint64_t sum) { return sum != 0; });
    if (first == sums.end()) return {};
    const auto others = static_cast<std::ptrdiff_t>(sums.size()) - std::ranges::count(sums, 0U) - 1;
    const glm::vec3& at = mesh.positions[static_cast<std::size_t>(first - sums.begin()) << kPlaceBits];
    char position[96];
    std::snprintf(position, sizeof position, "(%g, %g, %g)", double(at.x), double(at.y), double(at.z));
    std::string what = "the surface is not closed near " + std::string(position);
    if (others > 0) what += ", and at " + std::to_string(others) + (others == 1 ? " other place" : " other places");
    return fail(what, {}, "this is a fault of the program: report it with the tree; another --detail may avoid it");
}

} // namespace ramus::mesh
