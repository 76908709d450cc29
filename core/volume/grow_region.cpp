#include "core/volume/grow_region.h"

#include "core/base/mapped_pages.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <string>
#include <utility>

namespace ramus::volume {

namespace {

bool is_within(const glm::ivec3& voxel, const VoxelBox& box) {
    return glm::all(glm::greaterThanEqual(voxel, box.first)) && glm::all(glm::lessThanEqual(voxel, box.last));
}

glm::dvec3 centre_of(const glm::dmat4& to_patient, const glm::ivec3& voxel) {
    return glm::dvec3(to_patient * glm::dvec4(glm::dvec3(voxel), 1.0));
}

// The part of `within` whose centres can be closer than `radius_mm` to a place. May be empty (last < first).
VoxelBox voxels_around(const glm::dmat4& to_patient, const glm::dvec3& place_mm, double radius_mm,
                       const VoxelBox& within) {
    const glm::dmat4 to_voxel = glm::inverse(to_patient);
    const glm::dvec3 middle(to_voxel * glm::dvec4(place_mm, 1.0));
    const glm::dmat3 rows = glm::transpose(glm::dmat3(to_voxel));
    const glm::dvec3 reach = radius_mm * glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    const auto whole = [&](const glm::dvec3& at) { // stays in the range of int
        return glm::ivec3(glm::clamp(at, glm::dvec3(within.first) - 1.0, glm::dvec3(within.last) + 1.0));
    };
    return {glm::max(whole(glm::floor(middle - reach)), within.first),
            glm::min(whole(glm::ceil(middle + reach)), within.last)};
}

// The disc barriers, with the voxels near each, so that most steps need no test.
class DiscSteps {
public:
    DiscSteps(const std::vector<DiscBarrier>& discs, const glm::dmat4& to_patient, const VoxelBox& within)
        : to_patient_(to_patient) {
        for (const DiscBarrier& disc : discs) {
            VoxelBox near = voxels_around(to_patient, disc.centre_mm, disc.radius_mm, within);
            near.first -= 1, near.last += 1; // steps begin and end one voxel farther
            discs_.push_back({disc, near});
        }
    }
    // Whether a disc is near the row.
    [[nodiscard]] bool are_near(int j, int k) const {
        return std::ranges::any_of(discs_, [&](const Near& each) {
            return j >= each.box.first.y && j <= each.box.last.y && k >= each.box.first.z && k <= each.box.last.z;
        });
    }
    [[nodiscard]] bool let_pass(const glm::ivec3& from, const glm::ivec3& to) const {
        return std::ranges::none_of(
            discs_, [&](const Near& each) { return is_within(from, each.box) && crosses(from, to, each.disc); });
    }

private:
    struct Near {
        DiscBarrier disc;
        VoxelBox box;
    };
    [[nodiscard]] bool crosses(const glm::ivec3& from, const glm::ivec3& to, const DiscBarrier& disc) const {
        const glm::dvec3 a = centre_of(to_patient_, from) - disc.centre_mm;
        const glm::dvec3 b = centre_of(to_patient_, to) - disc.centre_mm;
        const double above = glm::dot(a, disc.normal), below = glm::dot(b, disc.normal);
        if ((above >= 0.0) == (below >= 0.0)) return false; // places in the plane count as above it
        return glm::length(glm::mix(a, b, above / (above - below))) <= disc.radius_mm;
    }

    glm::dmat4 to_patient_;
    std::vector<Near> discs_;
};

// A mask with the rows of BitMask, of which only pages with voxels take memory.
class PagedMask {
public:
    explicit PagedMask(const glm::ivec3& size)
        : size_(size), row_words_((static_cast<std::size_t>(size.x) + 2 + 63) / 64) {
        words_.resize(row_words_ * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z));
    }
    [[nodiscard]] std::size_t first_word(int j, int k) const {
        return row_words_ *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(k));
    }
    [[nodiscard]] std::uint64_t word(std::size_t at) const { return words_[at]; }
    [[nodiscard]] bool test(std::size_t row, int i) const { return (words_[row + word_of(i)] >> bit_of(i) & 1U) != 0; }
    void put(std::size_t row, int i, bool value) {
        const std::uint64_t bit = std::uint64_t{1} << bit_of(i);
        if (value)
            words_[row + word_of(i)] |= bit;
        else
            words_[row + word_of(i)] &= ~bit;
    }
    void set_run(std::size_t row, int first, int last) {
        for (std::size_t w = word_of(first); w <= word_of(last); ++w) {
            std::uint64_t bits = ~std::uint64_t{0};
            if (w == word_of(first)) bits &= ~std::uint64_t{0} << bit_of(first);
            if (w == word_of(last)) bits &= ~std::uint64_t{0} >> (63U - bit_of(last));
            words_[row + w] |= bits;
        }
    }
    // The first voxel from `i` to `last` that is not set; `last` + 1: none.
    [[nodiscard]] int next_unset(std::size_t row, int i, int last) const {
        while (i <= last) {
            const int left = 64 - static_cast<int>(bit_of(i)); // in this word
            const int set = std::countr_one(words_[row + word_of(i)] >> bit_of(i));
            i += set;
            if (set < left) break;
        }
        return std::min(i, last + 1);
    }
    static std::size_t word_of(int i) { return (static_cast<std::size_t>(i) + 1) / 64; }

private:
    static unsigned bit_of(int i) { return (static_cast<unsigned>(i) + 1) % 64; }
    glm::ivec3 size_;
    std::size_t row_words_;
    SparseArray<std::uint64_t> words_;
};

template <class Values> class RegionGrower {
public:
    RegionGrower(const Volume& volume, const Values& values, const RegionGrowing& growing)
        : volume_(volume), values_(values), growing_(growing), within_(whole_box()),
          discs_(growing.discs, volume.to_patient, within_),
          taken_(volume.size), region_{SparseMask(glm::ivec3(0)), 0, {within_.last, within_.first}, false, false, {}} {}

    Result<GrownRegion> run(const JobRange& job) {
        // Voxels in balls are marked as taken, and unmarked at the end.
        for_voxels_in_balls([&](std::size_t row, int i) { taken_.put(row, i, true); });
        for (const glm::ivec3& seed : growing_.seeds) start_at(seed);
        if (region_.count == 0)
            return fail("no seed has a value in the range", {}, "choose a wider range, or another seed");
        constexpr std::size_t kBetweenReports = 512; // few, because the values of long runs are slow to find
        const double most = std::min(static_cast<double>(growing_.most_voxels), voxels_within());
        for (std::size_t n = 0; !spans_.empty() && !region_.stopped_at_limit; ++n) {
            if (n % kBetweenReports == 0) {
                if (job.cancelled()) return fail("cancelled");
                job.report(static_cast<float>(static_cast<double>(region_.count) / most));
            }
            const Span span = spans_.front();
            spans_.pop_front();
            for (const auto& [j, k] :
                 {std::array{span.j - 1, span.k}, {span.j + 1, span.k}, {span.j, span.k - 1}, {span.j, span.k + 1}})
                if (j >= within_.first.y && j <= within_.last.y && k >= within_.first.z && k <= within_.last.z)
                    enter_row(span, j, k);
        }
        for_voxels_in_balls([&](std::size_t row, int i) { taken_.put(row, i, false); });
        finish();
        return std::move(region_);
    }

private:
    struct Span {
        int first, last, j, k;
    };

    [[nodiscard]] VoxelBox whole_box() const {
        const VoxelBox whole{glm::ivec3(0), volume_.size - 1};
        if (!growing_.box) return whole;
        return {glm::max(growing_.box->first, whole.first), glm::min(growing_.box->last, whole.last)};
    }
    [[nodiscard]] double voxels_within() const {
        const glm::dvec3 size(within_.last - within_.first + 1);
        return size.x * size.y * size.z;
    }
    [[nodiscard]] std::size_t first_value(int j, int k) const {
        return static_cast<std::size_t>(volume_.size.x) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(volume_.size.y) * static_cast<std::size_t>(k));
    }

    template <class Call> void for_voxels_in_balls(const Call& call) const {
        for (const BallBarrier& ball : growing_.balls) {
            const VoxelBox box = voxels_around(volume_.to_patient, ball.centre_mm, ball.radius_mm, within_);
            for (int k = box.first.z; k <= box.last.z; ++k)
                for (int j = box.first.y; j <= box.last.y; ++j)
                    for (int i = box.first.x; i <= box.last.x; ++i)
                        if (glm::distance(centre_of(volume_.to_patient, {i, j, k}), ball.centre_mm) <= ball.radius_mm)
                            call(taken_.first_word(j, k), i);
        }
    }

    void start_at(const glm::ivec3& seed) {
        const Row row(*this, seed.y, seed.z);
        if (!is_within(seed, within_) || !row.in_range(seed.x) || is_in_ball(seed)) {
            region_.unused.push_back(seed);
        } else if (row.is_open(seed.x)) { // not reached from an earlier seed
            add(extended(row, seed.x));
        }
    }
    [[nodiscard]] bool is_in_ball(const glm::ivec3& voxel) const {
        const glm::dvec3 place = centre_of(volume_.to_patient, voxel);
        return std::ranges::any_of(growing_.balls, [&](const BallBarrier& ball) {
            return glm::distance(place, ball.centre_mm) <= ball.radius_mm;
        });
    }

    // A row of voxels, with what belongs to all of them.
    struct Row {
        Row(const RegionGrower& grower, int row_j, int row_k)
            : all(grower), j(row_j), k(row_k), value(grower.first_value(row_j, row_k)),
              word(grower.taken_.first_word(row_j, row_k)), near_discs(grower.discs_.are_near(row_j, row_k)) {}
        [[nodiscard]] bool in_range(int i) const {
            const auto at = static_cast<double>(all.values_[value + static_cast<std::size_t>(i)]);
            return at >= all.growing_.low && at <= all.growing_.high;
        }
        [[nodiscard]] bool is_open(int i) const { return !all.taken_.test(word, i) && in_range(i); }
        // Whether the region grows within the row from a voxel to the next or previous one.
        [[nodiscard]] bool grows(int from, int to) const {
            return is_open(to) && (!near_discs || all.discs_.let_pass({from, j, k}, {to, j, k}));
        }
        const RegionGrower& all;
        int j, k;
        std::size_t value, word; // first of the row
        bool near_discs;
    };

    // The voxels of the row that are reached from an open one.
    [[nodiscard]] Span extended(const Row& row, int i) const {
        Span span{i, i, row.j, row.k};
        while (span.first > within_.first.x && row.grows(span.first, span.first - 1)) --span.first;
        while (span.last < within_.last.x && row.grows(span.last, span.last + 1)) ++span.last;
        return span;
    }

    void enter_row(const Span& from, int j, int k) {
        const Row row(*this, j, k);
        const auto next_after = [&](int i) { return taken_.next_unset(row.word, i, from.last); };
        for (int i = next_after(from.first); i <= from.last && !region_.stopped_at_limit; i = next_after(i + 1)) {
            if (!row.in_range(i)) continue;
            if (row.near_discs && !discs_.let_pass({i, from.j, from.k}, {i, j, k})) continue;
            add(extended(row, i)); // next_after() then continues behind these voxels
        }
    }

    void add(Span span) {
        const auto length = static_cast<std::uint64_t>(span.last - span.first + 1);
        const std::uint64_t left = growing_.most_voxels - region_.count;
        if (length > left) {
            region_.stopped_at_limit = true;
            if (left == 0) return;
            span.last = span.first + static_cast<int>(left) - 1;
        }
        taken_.set_run(taken_.first_word(span.j, span.k), span.first, span.last);
        region_.count += std::min(length, left);
        region_.bounds.first = glm::min(region_.bounds.first, glm::ivec3(span.first, span.j, span.k));
        region_.bounds.last = glm::max(region_.bounds.last, glm::ivec3(span.last, span.j, span.k));
        spans_.push_back(span);
    }

    void finish() {
        const auto& [first, last] = region_.bounds;
        SparseMask::Builder builder(volume_.size);
        for (int k = first.z; k <= last.z; ++k)
            for (int j = first.y; j <= last.y; ++j) {
                const std::size_t row = taken_.first_word(j, k);
                for (std::size_t w = PagedMask::word_of(first.x); w <= PagedMask::word_of(last.x); ++w)
                    builder.add(row + w, taken_.word(row + w));
            }
        region_.mask = std::move(builder).finish(SparseMask::Words::kFilled);
        region_.touches_border =
            glm::any(glm::equal(first, glm::ivec3(0))) || glm::any(glm::equal(last, volume_.size - 1));
    }

    const Volume& volume_;
    const Values& values_;
    const RegionGrowing& growing_;
    VoxelBox within_;
    DiscSteps discs_;
    PagedMask taken_;
    std::deque<Span> spans_; // to grow from, the oldest first: a region that stops at its limit is near its seeds
    GrownRegion region_;
};

Result<void> check_voxel(const Volume& volume, const glm::ivec3& seed) {
    if (!volume.overlaps.empty())
        return fail("its labels overlap, so that voxels have no single value", {}, "choose a scan");
    if (is_within(seed, {glm::ivec3(0), volume.size - 1})) return {};
    return fail("a seed is not in the volume: voxel (" + std::to_string(seed.x) + ", " + std::to_string(seed.y) + ", " +
                    std::to_string(seed.z) + ")",
                {}, "place it inside");
}

double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

} // namespace

Result<GrownRegion> grow_region(const Volume& volume, const RegionGrowing& growing, const JobRange& job) {
    if (growing.seeds.empty()) return fail("there is no seed to grow from", {}, "place one");
    for (const glm::ivec3& seed : growing.seeds)
        if (auto sound = check_voxel(volume, seed); !sound) return tl::unexpected(sound.error());
    if (!(growing.low <= growing.high)) return fail("the range of values is empty", {}, "choose low <= high");
    return std::visit(
        [&](const auto& values) -> Result<GrownRegion> { return RegionGrower(volume, values, growing).run(job); },
        volume.voxels);
}

Result<ValueRange> suggested_range(const Volume& volume, const glm::ivec3& seed) {
    if (auto sound = check_voxel(volume, seed); !sound) return tl::unexpected(sound.error());
    constexpr double kVoxels = 2.0;                            // on either side, along the finest axis
    constexpr double kMultiplier = 2.5;                        // ITK's default
    constexpr double kOutlier = 3.0, kDeviationOfMad = 1.4826; // for normally distributed values
    const glm::dvec3 spacing = spacing_mm(volume.to_patient);
    const glm::ivec3 reach(glm::round(kVoxels * std::min({spacing.x, spacing.y, spacing.z}) / spacing));
    const glm::ivec3 first = glm::max(seed - reach, glm::ivec3(0)), last = glm::min(seed + reach, volume.size - 1);
    std::vector<double> values;
    for (int k = first.z; k <= last.z; ++k)
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i) values.push_back(value_at(volume, {i, j, k}));
    std::vector<double> scratch = values;
    const double median = median_of(scratch);
    std::ranges::transform(values, scratch.begin(), [&](double value) { return std::abs(value - median); });
    const double most = kOutlier * kDeviationOfMad * median_of(scratch);
    std::erase_if(values, [&](double value) { return std::abs(value - median) > most; });
    double sum = 0.0, squares = 0.0;
    for (const double value : values) sum += value - median, squares += (value - median) * (value - median);
    const auto count = static_cast<double>(values.size());
    const double offset = sum / count;
    // As in ITK, the variance of a sample.
    const double variance = count > 1.0 ? std::max(0.0, (squares - count * offset * offset) / (count - 1.0)) : 0.0;
    ValueRange range{.mean = median + offset, .spread = std::sqrt(variance)};
    const double at_seed = value_at(volume, seed);
    range.low = std::min(range.mean - kMultiplier * range.spread, at_seed);
    range.high = std::max(range.mean + kMultiplier * range.spread, at_seed);
    return range;
}

} // namespace ramus::volume
