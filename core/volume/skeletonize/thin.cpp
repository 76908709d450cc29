#include "core/volume/skeletonize/thin.h"

#include "core/volume/skeletonize/simple_point.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace ramus::volume {

namespace {

using Address = VoxelSet::Address;
using Addresses = LargeArray<Address>;

class Thinner {
public:
    Thinner(const VoxelSet& set, const LargeArray<float>& distances)
        : set_(set), distances_(distances), left_(set.bits()), flags_(set.count(), 0, set.memory()),
          uphill_(set.count(), static_cast<std::uint8_t>(kCentreBit), set.memory()) {
        for (int bit = 0; bit < 27; ++bit) {
            steps_[static_cast<std::size_t>(bit)] = set.step(bit);
            per_step_[static_cast<std::size_t>(bit)] = static_cast<float>(1.0 / std::max(set.step_mm(bit), 1e-9));
        }
        const float least = static_cast<float>(std::min({set.spacing().x, set.spacing().y, set.spacing().z}));
        per_mm_ = kLevels / least;
    }

    Thinned run(const std::vector<Address>& kept, const JobRange& job) && {
        for (const Address at : kept) flags_[set_.number(at)] = kKept;
        queue_border();
        for (level_ = 0; level_ < queue_.size() && !job.cancelled(); ++level_) {
            // visit() may add voxels to this level.
            for (std::size_t n = 0; n < queue_[level_].size(); ++n) visit(queue_[level_][n]);
            queue_[level_] = Addresses(set_.memory());
            job.report(static_cast<float>(level_) / static_cast<float>(queue_.size()));
        }
        return {std::move(left_), std::move(uphill_)};
    }

private:
    enum Flag : std::uint8_t { kQueued = 1, kKept = 2 };
    static constexpr float kLevels = 8.0F; // levels of the queue for the shortest side of a voxel

    void queue(Address at) {
        const std::uint32_t number = set_.number(at);
        if (flags_[number] != 0) return;
        flags_[number] = kQueued;
        const std::size_t level = std::max(level_, static_cast<std::size_t>(distances_[number] * per_mm_));
        if (level >= queue_.size()) queue_.resize(level + 1, Addresses(set_.memory()));
        queue_[level].push_back(at);
    }

    void queue_border() {
        const SparseMask& bits = set_.bits();
        const std::size_t row = bits.row_words(), slice = row * static_cast<std::size_t>(bits.size().y);
        bits.for_words([&](std::size_t w, std::uint64_t word) { // words of the box's border are 0
            const std::uint64_t before = word << 1 | bits.word(w - 1) >> 63;
            const std::uint64_t behind = word >> 1 | bits.word(w + 1) << 63;
            const std::uint64_t inner =
                before & behind & bits.word(w - row) & bits.word(w + row) & bits.word(w - slice) & bits.word(w + slice);
            for (std::uint64_t left = word & ~inner; left != 0; left &= left - 1)
                queue(static_cast<Address>(w) * 64 + static_cast<Address>(std::countr_zero(left)));
        });
    }

    void visit(Address at) {
        flags_[set_.number(at)] &= static_cast<std::uint8_t>(~kQueued);
        const Neighbourhood around = neighbourhood(left_, at);
        if (!is_simple(around)) return; // queued again when a neighbour is removed
        left_.clear_bit(at);
        const float here = distances_[set_.number(at)];
        float steepest = -std::numeric_limits<float>::infinity();
        int uphill = kCentreBit;
        for (Neighbourhood left = around & kNeighbours; left != 0; left &= left - 1) {
            const auto bit = static_cast<std::size_t>(std::countr_zero(left));
            const auto to = static_cast<Address>(static_cast<std::int64_t>(at) + steps_[bit]);
            const float slope = (distances_[set_.number(to)] - here) * per_step_[bit];
            if (slope > steepest) steepest = slope, uphill = static_cast<int>(bit);
            queue(to);
        }
        uphill_[set_.number(at)] = static_cast<std::uint8_t>(uphill);
    }

    const VoxelSet& set_;
    const LargeArray<float>& distances_;
    SparseMask left_;
    LargeArray<std::uint8_t> flags_, uphill_; // by number of the voxel
    std::vector<Addresses> queue_;
    std::size_t level_ = 0;
    float per_mm_ = 1.0F;
    std::array<std::int64_t, 27> steps_{};
    std::array<float, 27> per_step_{}; // 1 / mm
};

} // namespace

Thinned thin(const VoxelSet& set, const LargeArray<float>& distances, const std::vector<Address>& kept,
             const JobRange& job) {
    return Thinner(set, distances).run(kept, job);
}

} // namespace ramus::volume
