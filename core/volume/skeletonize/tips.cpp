#include "core/volume/skeletonize/tips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <span>
#include <utility>

namespace ramus::volume {

namespace {

using Address = VoxelSet::Address;
constexpr float kFar = std::numeric_limits<float>::infinity();

// Geodesic distances through the set, by number of the voxel, from the start of spread().
class Ways {
public:
    // `open`: initially the set; spread() removes the pieces that it reaches.
    Ways(const VoxelSet& set, SparseMask& open, const JobRange& job)
        : set_(set), open_(open), job_(job), lengths_(set.count(), kFar, set.memory()) {
        for (int bit = 0; bit < 27; ++bit) {
            if (bit == kCentreBit) continue;
            lengths_mm_[static_cast<std::size_t>(bit)] = static_cast<float>(set.step_mm(bit));
        }
        width_ = static_cast<float>(std::min({set.spacing().x, set.spacing().y, set.spacing().z}));
    }
    [[nodiscard]] const LargeArray<float>& lengths() const { return lengths_; }
    [[nodiscard]] float length(Address at) const { return lengths_[set_.number(at)]; }

    // Dijkstra's algorithm with Dial's buckets, through the whole piece of `start`. `reached` gets all voxels of the
    // piece in ascending order of distance, then of address. Buckets have the width of the shortest step, so within a
    // bucket no voxel can shorten the path of another.
    void spread(Address start, LargeArray<Address>& reached) {
        reached.clear();
        buckets_.assign(1, {start});
        lengths_[set_.number(start)] = 0.0F;
        std::vector<std::size_t> firsts;
        for (std::size_t b = 0; b < buckets_.size() && !job_.cancelled(); ++b) {
            firsts.push_back(reached.size());
            for (std::size_t n = 0; n < buckets_[b].size(); ++n) {
                const Address at = buckets_[b][n];
                const float here = length(at);
                if (static_cast<std::size_t>(here / width_) != b) continue; // a shorter path was found meanwhile
                reached.push_back(at);
                open_.clear_bit(at);
                relax(at, here);
            }
            std::vector<Address>().swap(buckets_[b]);
        }
        firsts.push_back(reached.size());
        tbb::parallel_for(std::size_t{1}, firsts.size(), [&](std::size_t b) {
            const std::span<Address> bucket(reached.data() + firsts[b - 1], firsts[b] - firsts[b - 1]);
            std::vector<std::pair<float, Address>> keys;
            for (const Address at : bucket) keys.emplace_back(length(at), at);
            std::ranges::sort(keys);
            for (std::size_t n = 0; n < keys.size(); ++n) bucket[n] = keys[n].second;
        });
    }

private:
    void relax(Address at, float here) {
        set_.for_neighbours(at, open_, [&](Address to, std::uint32_t number, int bit) {
            float& length = lengths_[number];
            const float through = here + lengths_mm_[static_cast<std::size_t>(bit)];
            if (!(through < length)) return;
            const bool same_bucket = length < kFar && static_cast<std::size_t>(length / width_) ==
                                                          static_cast<std::size_t>(through / width_);
            length = through;
            if (same_bucket) return;
            const auto bucket = static_cast<std::size_t>(through / width_);
            if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
            buckets_[bucket].push_back(to);
        });
    }

    const VoxelSet& set_;
    SparseMask& open_;
    const JobRange& job_;
    LargeArray<float> lengths_;
    std::array<float, 27> lengths_mm_{};
    float width_;
    std::vector<std::vector<Address>> buckets_;
};

// A region around a local maximum of the distance from the start. It grows downwards from its farthest voxel.
struct Summit {
    Address farthest;
    float length;    // distance of `farthest` from the start
    float thickness; // greatest distance to the outside in the region
};

class Summits {
public:
    Summits(const VoxelSet& set, const LargeArray<float>& distances, const LargeArray<float>& lengths,
            double bulge_size)
        : set_(set), distances_(distances), lengths_(lengths), bulge_size_(static_cast<float>(bulge_size)),
          voxel_(static_cast<float>(std::max({set.spacing().x, set.spacing().y, set.spacing().z}))),
          summit_of_(set.count(), set.memory()) {}

    // `order`: the voxels of a piece, the nearest to its start first. `done`: a mask that must not have them; find()
    // adds them.
    void find(const LargeArray<Address>& order, SparseMask& done, std::vector<Address>& tips) {
        summits_.clear(), joined_.clear();
        for (auto next = order.rbegin(); next != order.rend(); ++next) {
            const Address at = *next;
            const std::uint32_t number = set_.number(at);
            std::uint32_t own = kNone;
            std::uint32_t last = kNone;
            set_.for_neighbours(at, done, [&](Address, std::uint32_t neighbour, int) {
                const std::uint32_t other = summit_of_[neighbour];
                if (other == last) return;
                last = other;
                const std::uint32_t root = find_root(other);
                own = own == kNone || own == root ? root : join(own, root, lengths_[number], tips);
            });
            if (own == kNone) {
                own = static_cast<std::uint32_t>(summits_.size());
                summits_.push_back({at, lengths_[number], 0.0F});
                joined_.push_back(own);
            }
            summits_[own].thickness = std::max(summits_[own].thickness, distances_[number]);
            summit_of_[number] = own;
            done.set_bit(at);
        }
        if (!order.empty()) tips.push_back(summits_[find_root(0)].farthest);
    }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    std::uint32_t find_root(std::uint32_t n) {
        while (joined_[n] != n) n = joined_[n] = joined_[joined_[n]];
        return n;
    }
    // Merges two summits that meet at distance `saddle` from the start. The lower one becomes a tip if it is prominent.
    std::uint32_t join(std::uint32_t a, std::uint32_t b, float saddle, std::vector<Address>& tips) {
        if (summits_[a].length < summits_[b].length) std::swap(a, b);
        const Summit& lower = summits_[b];
        if (lower.length - saddle > bulge_size_ * lower.thickness + voxel_) tips.push_back(lower.farthest);
        summits_[a].thickness = std::max(summits_[a].thickness, lower.thickness);
        joined_[b] = a;
        return a;
    }

    const VoxelSet& set_;
    const LargeArray<float>&distances_, &lengths_;
    float bulge_size_, voxel_;
    LargeArray<std::uint32_t> summit_of_; // by number of the voxel
    std::vector<Summit> summits_;
    std::vector<std::uint32_t> joined_;
};

} // namespace

namespace {

// The voxel of the piece of `first` that is the most steps away (26-connected breadth-first search, on words of bits).
// Removes the piece from `open`.
Address farthest_from(Address first, const VoxelSet& set, SparseMask& open) {
    struct Word {
        std::size_t at;
        std::uint64_t bits;
    };
    std::vector<Word> front{{first / 64, std::uint64_t{1} << first % 64}}, next;
    open.clear_bit(first);
    const auto take = [&](std::size_t at, std::uint64_t near) {
        if (near == 0) return;
        const std::size_t place = open.place(at);
        const std::uint64_t reached = place == SparseMask::kNone ? 0 : open.at_place(place) & near;
        if (reached == 0) return;
        open.clear_bits(place, reached);
        next.push_back({at, reached});
    };
    const auto row = static_cast<std::int64_t>(set.row_bits() / 64),
               slice = static_cast<std::int64_t>(set.slice_bits() / 64);
    while (true) {
        for (const Word& word : front)
            for (const std::int64_t z : {-slice, std::int64_t{0}, slice})
                for (const std::int64_t y : {-row, std::int64_t{0}, row}) {
                    const auto at = static_cast<std::size_t>(static_cast<std::int64_t>(word.at) + y + z);
                    take(at, word.bits | word.bits << 1U | word.bits >> 1U);
                    if ((word.bits & 1U) != 0) take(at - 1, std::uint64_t{1} << 63U);
                    if ((word.bits >> 63U) != 0) take(at + 1, 1);
                }
        if (next.empty()) break;
        front.swap(next);
        next.clear();
    }
    const Word& last = *std::ranges::min_element(front, {}, &Word::at);
    return last.at * 64 + static_cast<Address>(std::countr_zero(last.bits));
}

// Moves a tip uphill in distance to the outside, toward the middle of the vessel, while the ball around it reaches back
// to the end.
constexpr float kReachBack = 1.0F;
Address middle_of_end(Address tip, const VoxelSet& set, const LargeArray<float>& distances,
                      const LargeArray<float>& lengths) {
    const float end = lengths[set.number(tip)];
    Address at = tip;
    while (end - lengths[set.number(at)] < kReachBack * distances[set.number(at)]) {
        Address best = at;
        set.for_neighbours(at, [&](Address to, std::uint32_t number, int) {
            if (distances[number] > distances[set.number(best)]) best = to;
        });
        if (best == at) break;
        at = best;
    }
    return at;
}

} // namespace

std::vector<Address> find_tips(const VoxelSet& set, const std::function<const LargeArray<float>&()>& distances,
                               double bulge_size, const JobRange& job) {
    std::vector<Address> tips;
    LargeArray<Address> reached(set.memory());
    SparseMask ahead = set.bits();
    Ways ways(set, ahead, job);
    std::optional<Summits> summits;
    SparseMask open = set.bits();
    std::uint64_t done = 0;
    set.for_each([&](Address first) {
        if (ways.length(first) < kFar || job.cancelled()) return;
        const Address start = farthest_from(first, set, open); // the end of a vessel
        ways.spread(start, reached);
        if (job.cancelled()) return; // some voxels have no distance yet
        const std::size_t before = tips.size();
        if (!summits) summits.emplace(set, distances(), ways.lengths(), bulge_size);
        summits->find(reached, ahead, tips);
        if (std::find(tips.begin() + static_cast<std::ptrdiff_t>(before), tips.end(), start) == tips.end())
            tips.push_back(start);
        for (std::size_t t = before; t < tips.size(); ++t)
            tips[t] = middle_of_end(tips[t], set, distances(), ways.lengths());
        done += reached.size();
        job.report(static_cast<float>(done) / static_cast<float>(set.count()));
    });
    return tips;
}

} // namespace ramus::volume
