#include "core/volume/bit_mask.h"

#include "core/volume/sparse_mask.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <string>
#include <type_traits>
#include <utility>

namespace ramus::volume {

BitMask::BitMask(const glm::ivec3& size) : size_(size), row_words_((static_cast<std::size_t>(size.x) + 2 + 63) / 64) {
    words_.resize(first_of(0, size.z), 0);
}

bool BitMask::test(const glm::ivec3& voxel) const {
    for (int axis = 0; axis < 3; ++axis)
        if (voxel[axis] < 0 || voxel[axis] >= size_[axis]) return false;
    const auto bit = static_cast<std::size_t>(voxel.x) + 1;
    return (row(voxel.y, voxel.z)[bit / 64] >> (bit % 64) & 1) != 0;
}

void BitMask::set(const glm::ivec3& voxel) {
    const auto bit = static_cast<std::size_t>(voxel.x) + 1;
    row(voxel.y, voxel.z)[bit / 64] |= std::uint64_t{1} << (bit % 64);
}

void BitMask::clear(const glm::ivec3& voxel) {
    const auto bit = static_cast<std::size_t>(voxel.x) + 1;
    row(voxel.y, voxel.z)[bit / 64] &= ~(std::uint64_t{1} << (bit % 64));
}

std::uint64_t BitMask::count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : words_) sum += static_cast<std::uint64_t>(std::popcount(word));
    return sum;
}

namespace {

template <class T> bool all_zero(const T* values, std::size_t count) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
    std::uint8_t any = 0;
    for (std::size_t n = 0; n < count * sizeof(T); ++n) any |= bytes[n];
    return any == 0;
}

template <class T, class Inside>
void fill_row(const T* values, std::size_t count, std::span<std::uint64_t> row, const Inside& is_inside) {
    // Most rows of a vessel mask are completely outside.
    const bool skip_zeros = !is_inside(T(0));
    if (skip_zeros && all_zero(values, count)) return;
    for (std::size_t word = 0, first = 0; first < count; ++word) {
        const std::size_t begin = word == 0 ? 1 : 0;
        const std::size_t bits = std::min(64 - begin, count - first);
        if (!skip_zeros || !all_zero(values + first, bits)) {
            std::uint64_t gathered = 0;
            for (std::size_t n = 0; n < bits; ++n)
                gathered |= std::uint64_t{is_inside(values[first + n])} << (begin + n);
            row[word] = gathered;
        }
        first += bits;
    }
}

// The bits of a slice, with rows as in BitMask.
struct SliceBits {
    std::size_t columns, rows, row_words;
    std::span<std::uint64_t> words;
    [[nodiscard]] std::span<std::uint64_t> row(std::size_t j) const { return words.subspan(j * row_words, row_words); }
};

template <class T, class Inside>
void fill_slice(const SparseArray<T>& values, int k, const SliceBits& slice, const Inside& is_inside) {
    for (std::size_t j = 0; j < slice.rows; ++j) {
        const std::size_t first = slice.columns * (j + slice.rows * static_cast<std::size_t>(k));
        fill_row(values.data() + first, slice.columns, slice.row(j), is_inside);
    }
}

// Sets the voxels [begin, end) of a row.
void set_voxels(std::span<std::uint64_t> row, std::size_t begin, std::size_t end) {
    const std::size_t first = (begin + 1) / 64, last = end / 64; // bit i + 1 is voxel i
    const std::uint64_t from = ~std::uint64_t{0} << (begin + 1) % 64, upto = ~std::uint64_t{0} >> (63 - end % 64);
    if (first == last) {
        row[first] |= from & upto;
        return;
    }
    row[first] |= from;
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(first) + 1, row.begin() + static_cast<std::ptrdiff_t>(last),
              ~std::uint64_t{0});
    row[last] |= upto;
}

template <class T, class Inside>
void fill_slice(const RunsOf<T>& runs, int k, const SliceBits& slice, const Inside& is_inside) {
    const std::size_t columns = slice.columns, voxels = columns * slice.rows;
    const std::size_t first = voxels * static_cast<std::size_t>(k);
    runs.for_runs(first, first + voxels, [&](std::size_t begin, std::size_t end, T value) {
        if (!is_inside(value)) return;
        for (std::size_t at = begin - first; at < end - first;) {
            const std::size_t column = at % columns, count = std::min(columns - column, end - first - at);
            set_voxels(slice.row(at / columns), column, column + count);
            at += count;
        }
    });
}

// Collects all words of all slices.
class AllWords {
public:
    explicit AllWords(const glm::ivec3& size) : mask_(size) {}
    template <class Fill> void fill(const Fill& fill_slice_k) {
        tbb::parallel_for(0, mask_.size().z, [&](int k) {
            const auto first = mask_.row(0, k);
            fill_slice_k(k, std::span(first.data(), first.size() * static_cast<std::size_t>(mask_.size().y)));
        });
    }
    BitMask finish() && { return std::move(mask_); }

private:
    BitMask mask_;
};

// Collects the words that hold voxels, some slices at a time.
class FilledWords {
public:
    explicit FilledWords(const glm::ivec3& size) : size_(size), builder_(size) {}
    template <class Fill> void fill(const Fill& fill_slice_k) {
        struct Filled {
            std::size_t word;
            std::uint64_t bits;
        };
        constexpr int kAtOnce = 32;
        const std::size_t slice_words =
            (static_cast<std::size_t>(size_.x) + 2 + 63) / 64 * static_cast<std::size_t>(size_.y);
        tbb::enumerable_thread_specific<std::vector<std::uint64_t>> scratch;
        std::array<std::vector<Filled>, kAtOnce> found;
        for (int first = 0; first < size_.z; first += kAtOnce) {
            const int end = std::min(first + kAtOnce, size_.z);
            tbb::parallel_for(first, end, [&](int k) {
                std::vector<std::uint64_t>& words = scratch.local();
                words.assign(slice_words, 0);
                fill_slice_k(k, std::span(words));
                std::vector<Filled>& filled = found[static_cast<std::size_t>(k - first)];
                filled.clear();
                for (std::size_t w = 0; w < words.size(); ++w)
                    if (words[w] != 0) filled.push_back({slice_words * static_cast<std::size_t>(k) + w, words[w]});
            });
            for (int k = first; k < end; ++k)
                for (const Filled& filled : found[static_cast<std::size_t>(k - first)])
                    builder_.add(filled.word, filled.bits);
        }
    }
    SparseMask finish() && { return std::move(builder_).finish(); }

private:
    glm::ivec3 size_;
    SparseMask::Builder builder_;
};

// Kept: AllWords or FilledWords.
template <class Kept, class Values, class Inside>
auto fill(const Volume& volume, const Values& values, const Inside& is_inside, const JobRange& job)
    -> Result<decltype(std::declval<Kept>().finish())> {
    Kept kept(volume.size);
    const SliceBits shape{static_cast<std::size_t>(volume.size.x),
                          static_cast<std::size_t>(volume.size.y),
                          (static_cast<std::size_t>(volume.size.x) + 2 + 63) / 64,
                          {}};
    std::atomic<int> done{0};
    std::atomic<bool> any{false};
    kept.fill([&](int k, std::span<std::uint64_t> words) {
        if (job.cancelled()) return;
        fill_slice(values, k, SliceBits{shape.columns, shape.rows, shape.row_words, words}, is_inside);
        if (std::ranges::any_of(words, [](std::uint64_t word) { return word != 0; })) any = true;
        job.report(static_cast<float>(++done) / static_cast<float>(volume.size.z));
    });
    if (job.cancelled()) return fail("cancelled");
    if (!any) return fail("nothing is inside", {}, "choose another label or isovalue");
    return std::move(kept).finish();
}

// A lookup table for a type of at most two bytes: whether the value with these bits is one of the labels.
template <class T> std::vector<std::uint8_t> table_of(const std::vector<std::int32_t>& labels) {
    std::vector<std::uint8_t> table(std::size_t{1} << (8 * sizeof(T)), labels.empty() ? 1 : 0);
    if (labels.empty()) table[0] = 0;
    for (const std::int32_t label : labels)
        if (std::in_range<T>(label)) table[static_cast<std::make_unsigned_t<T>>(label)] = 1;
    return table;
}

template <class T> bool holds(const SparseArray<T>& values, T label) {
    return std::ranges::find(values, label) != values.end();
}
bool holds(const VoxelRuns& runs, VoxelRuns::Value label) {
    bool found = false;
    runs.for_runs(0, runs.size(), [&](std::size_t, std::size_t, VoxelRuns::Value value) { found |= value == label; });
    return found;
}

tl::unexpected<Error> not_there(const Volume& volume, std::int32_t label) {
    const LabelName* name = name_of_label(volume, label);
    if (volume.segmentation && name != nullptr)
        return fail("segment " + std::to_string(label) + ", \"" + name->name + "\", has no voxels", {},
                    "choose another one; ramus info lists the labels");
    return fail("no voxel has label " + std::to_string(label), {}, "ramus info lists the labels");
}

template <class T, class Kept, class Values>
auto fill_labels(const Volume& volume, const Values& values, std::vector<std::int32_t> labels, const JobRange& job)
    -> Result<decltype(std::declval<Kept>().finish())> {
    // A voxel can have a label alone, or together with others (overlaps).
    const auto is_there = [&](std::int32_t value) {
        return std::in_range<T>(value) && holds(values, static_cast<T>(value));
    };
    const std::vector<std::int32_t> wanted = labels;
    for (const std::int32_t label : wanted) {
        bool there = is_there(label);
        for (const Overlap& overlap : volume.overlaps)
            if (std::ranges::binary_search(overlap.labels, label)) {
                labels.push_back(overlap.value);
                there = there || is_there(overlap.value);
            }
        if (!there) return not_there(volume, label);
    }
    if constexpr (sizeof(T) <= 2) {
        const auto table = table_of<T>(labels);
        return fill<Kept>(
            volume, values, [&](T v) { return table[static_cast<std::make_unsigned_t<T>>(v)] != 0; }, job);
    } else {
        std::ranges::sort(labels);
        return fill<Kept>(
            volume, values, [&](T v) { return labels.empty() ? v != 0 : std::ranges::binary_search(labels, v); }, job);
    }
}

} // namespace

std::optional<double> isovalue_of(const Volume& volume, const Selection& selection) {
    if (selection.isovalue) return selection.isovalue;
    if (selection.labels.empty() && !holds_whole_numbers(volume)) return 0.5;
    return std::nullopt;
}

namespace {

template <class Kept>
auto kept_inside(const Volume& volume, const Selection& selection, const JobRange& job)
    -> Result<decltype(std::declval<Kept>().finish())> {
    using Mask = Result<decltype(std::declval<Kept>().finish())>;
    if (!selection.labels.empty() && !holds_whole_numbers(volume))
        return fail("its values are fractions, not labels", {}, "choose an --isovalue");
    if (selection.labels.empty() && !selection.isovalue && !looks_like_a_mask(volume))
        return fail("its values, from " + std::to_string(volume.minimum) + " to " + std::to_string(volume.maximum) +
                        ", are not those of a mask",
                    {}, "choose an --isovalue, or a --label");
    if (selection.isovalue && !volume.overlaps.empty())
        return fail("its values are segments that overlap, not those of a scan", {}, "choose labels");
    const auto isovalue = isovalue_of(volume, selection);
    RAMUS_TRY(labels, label_numbers(volume, selection.labels));
    return std::visit(
        [&]<class Values>(const Values& values) -> Mask {
            using T = std::decay_t<decltype(values[0])>;
            if (isovalue) {
                const double value = volume.threshold ? 1.0 : *isovalue;
                return fill<Kept>(
                    volume, values, [value](T v) { return static_cast<double>(v) >= value; }, job);
            }
            if constexpr (std::is_integral_v<T>) return fill_labels<T, Kept>(volume, values, labels, job);
            return fail("its values are fractions, not labels", {}, "choose an --isovalue");
        },
        volume.voxels);
}

} // namespace

Result<BitMask> inside(const Volume& volume, const Selection& selection, const JobRange& job) {
    return kept_inside<AllWords>(volume, selection, job);
}

Result<SparseMask> inside_sparsely(const Volume& volume, const Selection& selection, const JobRange& job) {
    return kept_inside<FilledWords>(volume, selection, job);
}

} // namespace ramus::volume
