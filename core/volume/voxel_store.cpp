#include "core/volume/voxel_store.h"

#include "core/base/memory.h"
#include "core/volume/end_of_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <type_traits>
#include <utility>

namespace ramus::volume {

namespace {

// Adding and subtracting a number whose last bit has the value 1 rounds to whole numbers: whole numbers stay the same,
// and fractions change.
template <class Value> bool is_whole(Value value) {
    constexpr Value kOnes = std::is_same_v<Value, float> ? Value(12582912.0) : Value(6755399441055744.0);
    constexpr Value kAllWhole = kOnes / 3;
    return (std::abs(value) >= kAllWhole) | ((value + kOnes) - kOnes == value);
}

// Runs are kept if they take at most this share of an array. The decision needs some runs first.
constexpr double kRunsShare = 0.5, kRunsSlack = 1 << 18;
constexpr std::array<double, 5> kBytesOfKind = {1, 2, 2, 4, 4};

// Number types of files that can exceed 32 bits.
template <class Raw>
constexpr bool kMayBeLarge = std::is_integral_v<Raw> && (sizeof(Raw) > 4 || std::is_same_v<Raw, std::uint32_t>);

template <class Kept> constexpr bool kIsRuns = false;
template <class T> constexpr bool kIsRuns<RunsOf<T>> = true;

template <class T, class To> void move_values(RunsOf<T>& from, std::size_t first, std::size_t end, To* to) {
    from.for_runs(first, end, [&](std::size_t begin, std::size_t stop, T value) {
        if (value != T(0)) std::fill(to + begin, to + stop, static_cast<To>(value));
    });
    if (end < from.size()) from.release_before(end);
}
template <class From, class To> void move_values(SparseArray<From>& from, std::size_t first, std::size_t end, To* to) {
    copy_sparsely(from.data() + first, end - first, to + first);
    empty_pages(from.data() + first, (end - first) * sizeof(From));
}

template <class Raw> double scaled(Raw raw, const Scaling& scaling) {
    const auto value = static_cast<double>(raw);
    return scaling.none() ? value : scaling.slope * value + scaling.intercept;
}

std::string text_of(double whole) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.0f", whole);
    return text.data();
}

} // namespace

VoxelStore::VoxelStore(const glm::ivec3& size, const Keeping& keeping, std::string name)
    : size_(size), total_(voxel_count(size)), keeping_(keeping), name_(std::move(name)), voxels_(VoxelRuns()) {}

std::string VoxelStore::voxel_name(std::size_t at) const {
    const auto x = static_cast<std::size_t>(size_.x);
    const auto y = static_cast<std::size_t>(size_.y);
    return "voxel (" + std::to_string(at % x) + ", " + std::to_string(at / x % y) + ", " + std::to_string(at / x / y) +
           ")";
}

tl::unexpected<Error> VoxelStore::not_finite(std::size_t at) const {
    return fail("the value of " + voxel_name(at) + " is not finite", name_,
                "replace it, by 0 if nothing was measured there");
}

template <class Value> VoxelStore::Range VoxelStore::range_of(const Value* values, std::size_t count) const {
    Value least = values[0];
    Value most = values[0];
    bool whole = true;
    bool finite = true;
    for (std::size_t n = 0; n < count; ++n) {
        least = values[n] < least ? values[n] : least;
        most = values[n] > most ? values[n] : most;
        if constexpr (std::is_floating_point_v<Value>) {
            whole &= is_whole(values[n]);
            finite &= values[n] - values[n] == Value(0);
        }
    }
    return {static_cast<double>(least), static_cast<double>(most), whole, finite};
}

template <class To> void VoxelStore::move_to_array() {
    SparseArray<To> larger;
    larger.resize(total_);
    // Releases the old memory step by step, so that a scan is never in memory twice.
    constexpr std::size_t kAtOnce = std::size_t{1} << 21;
    for (std::size_t first = 0; first < used_; first += kAtOnce)
        std::visit([&](auto& from) { move_values(from, first, std::min(first + kAtOnce, used_), larger.data()); },
                   voxels_);
    voxels_ = std::move(larger);
}

void VoxelStore::move_to(Kind kind) {
    if (static_cast<std::size_t>(kind) == voxels_.index()) return;
    constexpr std::array kMoves = {&VoxelStore::move_to_array<std::uint8_t>, &VoxelStore::move_to_array<std::uint16_t>,
                                   &VoxelStore::move_to_array<std::int16_t>, &VoxelStore::move_to_array<std::int32_t>,
                                   &VoxelStore::move_to_array<float>};
    (this->*kMoves[static_cast<std::size_t>(kind)])();
}

// The smallest kind of array that holds all values so far.
VoxelStore::Kind VoxelStore::smallest_kind() const {
    const auto within = [&](double low, double high) { return whole_ && least_ >= low && most_ <= high; };
    if (within(0, 255)) return Kind::kUint8;
    if (within(0, 65535)) return Kind::kUint16;
    if (within(-32768, 32767)) return Kind::kInt16;
    if (within(-2147483648.0, 2147483647.0)) return Kind::kInt32;
    return Kind::kFloat;
}

// Peak memory if all values are stored in an array of this kind. A conversion never holds more than the larger of its
// two arrays, because it releases memory as fast as it fills other memory.
double VoxelStore::bytes_to_be(Kind kind) const {
    const double bytes = kBytesOfKind[static_cast<std::size_t>(kind)] * static_cast<double>(total_);
    return std::max(bytes, bytes_of_runs().value_or(0.0));
}

std::optional<double> VoxelStore::bytes_of_runs() const {
    return std::visit(
        []<class Kept>(const Kept& kept) -> std::optional<double> {
            if constexpr (kIsRuns<Kept>) return kept.bytes();
            return std::nullopt;
        },
        voxels_);
}

bool VoxelStore::are_runs_worth_it(double slack_bytes) const {
    const double array = kBytesOfKind[static_cast<std::size_t>(smallest_kind())] * static_cast<double>(used_);
    return bytes_of_runs().value_or(HUGE_VAL) <= kRunsShare * array + slack_bytes;
}

Result<void> VoxelStore::check_memory(double bytes) const {
    if (bytes <= keeping_.memory_bytes) return {};
    return fail(takes_too_much("the volume", bytes, keeping_.memory_bytes), name_,
                "crop it, or allow more with --memory");
}

Result<void> VoxelStore::make_room_for(const Range& range, bool exact) {
    const bool first = used_ == 0;
    least_ = first ? range.least : std::min(least_, range.least);
    most_ = first ? range.most : std::max(most_, range.most);
    whole_ = whole_ && range.whole;
    const Kind kind = smallest_kind();
    if (kind == Kind::kFloat && exact)
        return fail("its whole numbers, up to " + text_of(std::abs(least_) > most_ ? least_ : most_) +
                        ", cannot be kept exactly",
                    name_, "number the labels anew, below 2147483648");
    if (kind == Kind::kFloat && std::max(std::abs(least_), std::abs(most_)) > std::numeric_limits<float>::max())
        return fail("its values exceed single precision", name_, "scale them");
    if (auto fits = check_memory(bytes_to_be(kind)); !fits) return fits;
    move_to(kind);
    return {};
}

template <class Value> Result<void> VoxelStore::put(const Value* values, std::size_t count) {
    const Range range = range_of(values, count);
    if (!range.finite) {
        const auto at = static_cast<std::size_t>(
            std::find_if(values, values + count, [](Value v) { return !std::isfinite(static_cast<double>(v)); }) -
            values);
        return not_finite(used_ + at);
    }
    if (auto room = make_room_for(range, std::is_integral_v<Value>); !room) return room;
    std::visit(
        [&]<class Kept>(Kept& kept) {
            if constexpr (!kIsRuns<Kept>) copy_sparsely(values, count, kept.data() + used_);
        },
        voxels_);
    used_ += count;
    return {};
}

template <class Runs, class Raw>
std::size_t VoxelStore::put_runs_in(Runs& runs, const Raw* raw, std::size_t count, const Scaling& scaling) {
    using Value = typename Runs::Value;
    constexpr double kMost = static_cast<double>(std::numeric_limits<Value>::max());
    constexpr double kLeast = std::is_integral_v<Value> ? 0.0 : -kMost;
    std::size_t n = 0;
    while (n < count && are_runs_worth_it(kRunsSlack)) {
        const double value = scaled(raw[n], scaling);
        if (!(value >= kLeast && value <= kMost && (!std::is_integral_v<Value> || is_whole(value)))) break;
        const std::size_t end = end_of_run(raw, n, count);
        runs.add(static_cast<Value>(value), end - n);
        least_ = used_ == 0 ? value : std::min(least_, value);
        most_ = used_ == 0 ? value : std::max(most_, value);
        used_ += end - n;
        n = end;
    }
    return n;
}

template <class Raw> std::size_t VoxelStore::put_runs(const Raw* raw, std::size_t count, const Scaling& scaling) {
    if (auto* fractions = std::get_if<FractionRuns>(&voxels_)) return put_runs_in(*fractions, raw, count, scaling);
    auto* runs = std::get_if<VoxelRuns>(&voxels_);
    if (runs == nullptr) return 0;
    const std::size_t put = put_runs_in(*runs, raw, count, scaling);
    if (put == count || !are_runs_worth_it(kRunsSlack)) return put;
    const double value = scaled(raw[put], scaling);
    if (!std::isfinite(value) || is_whole(value)) return put;
    // Converts the runs at the first fraction.
    FractionRuns fractions;
    runs->for_runs(0, used_, [&](std::size_t begin, std::size_t end, VoxelRuns::Value whole) {
        fractions.add(static_cast<float>(whole), end - begin);
    });
    voxels_ = std::move(fractions);
    whole_ = false;
    return put + put_runs_in(std::get<FractionRuns>(voxels_), raw + put, count - put, scaling);
}

template <class Raw>
std::vector<double> VoxelStore::without_nan(const Raw* raw, std::size_t count, const Scaling& scaling) {
    std::vector<double> values(count);
    for (std::size_t n = 0; n < count; ++n) {
        const auto value = static_cast<double>(raw[n]);
        if (!std::isnan(value)) {
            values[n] = scaled(value, scaling);
            continue;
        }
        ++nan_count_;
        if (nan_.empty() || nan_.back().end != used_ + n) nan_.push_back({used_ + n, used_ + n});
        ++nan_.back().end;
    }
    return values;
}

template <class Raw> Result<std::vector<std::int32_t>> VoxelStore::in_32_bits(const Raw* raw, std::size_t count) {
    using Wide = std::conditional_t<std::is_signed_v<Raw>, std::int64_t, std::uint64_t>;
    std::vector<std::int32_t> values(count);
    for (std::size_t n = 0; n < count; ++n) {
        if (n > 0 && raw[n] == raw[n - 1]) {
            values[n] = values[n - 1];
            continue;
        }
        const auto number = large_.number_of(static_cast<Wide>(raw[n]));
        if (!number)
            return fail("its whole numbers, such as " + std::to_string(raw[n]) + ", cannot all be kept exactly", name_,
                        "number the labels anew, below 2147483648");
        values[n] = *number;
    }
    return values;
}

template <class Raw>
Result<std::vector<std::uint8_t>> VoxelStore::compared(const Raw* raw, std::size_t count, const Scaling& scaling) {
    std::vector<std::uint8_t> inside(count, 0);
    for (std::size_t n = 0; n < count; ++n) {
        const double value = scaled(raw[n], scaling);
        if (std::isnan(static_cast<double>(raw[n])))
            ++nan_count_;
        else if (!std::isfinite(value))
            return not_finite(used_ + n);
        else
            inside[n] = value >= *keeping_.threshold ? 1 : 0;
    }
    return inside;
}

template <class Raw> Result<void> VoxelStore::append(const Raw* raw, std::size_t count, const Scaling& scaling) {
    if (!keeping_.threshold) return add(raw, count, scaling);
    RAMUS_TRY(inside, compared(raw, count, scaling));
    return add(inside.data(), count, {});
}

template <class Raw> Result<void> VoxelStore::add(const Raw* raw, std::size_t count, const Scaling& scaling) {
    if constexpr (std::is_floating_point_v<Raw>)
        if (std::any_of(raw, raw + count, [](Raw value) { return std::isnan(value); })) {
            const std::vector<double> values = without_nan(raw, count, scaling);
            return add(values.data(), count, Scaling{});
        }
    if constexpr (kMayBeLarge<Raw>)
        if (scaling.none()) {
            RAMUS_TRY(values, in_32_bits(raw, count));
            return add(values.data(), count, Scaling{});
        }
    const std::size_t kept = put_runs(raw, count, scaling);
    if (auto fits = check_memory(bytes_of_runs().value_or(0.0)); !fits) return fits;
    raw += kept, count -= kept;
    if (count == 0) return {};
    if (scaling.none()) return put(raw, count);
    std::vector<double> values(count);
    for (std::size_t n = 0; n < count; ++n) values[n] = scaled(raw[n], scaling);
    return put(values.data(), count);
}

template Result<void> VoxelStore::append(const std::uint8_t*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const std::int8_t*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const std::uint16_t*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const std::int16_t*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const std::uint32_t*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const std::int32_t*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const std::uint64_t*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const std::int64_t*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const float*, std::size_t, const Scaling&);
template Result<void> VoxelStore::append(const double*, std::size_t, const Scaling&);

// If there are values below 0, as in a scan, 0 could be inside: NaN becomes the least value.
Result<void> VoxelStore::settle_nan() {
    if (nan_count_ > 0 && nan_count_ == total_) return fail("all its values are NaN", name_, "choose another file");
    if (nan_.empty() || least_ >= 0.0) return {};
    const Kind kind = smallest_kind();
    if (bytes_of_runs()) {
        if (auto fits = check_memory(bytes_to_be(kind)); !fits) return fits;
        move_to(kind);
    }
    std::visit(
        [&]<class Kept>(Kept& kept) {
            if constexpr (!kIsRuns<Kept>)
                for (const Stretch& stretch : nan_)
                    std::fill(kept.data() + stretch.begin, kept.data() + stretch.end,
                              static_cast<typename Kept::value_type>(least_));
        },
        voxels_);
    return {};
}

void VoxelStore::finish(Volume& volume) && {
    if (nan_count_ > 0)
        volume.notes.push_back(std::to_string(nan_count_) + (nan_count_ == 1 ? " voxel is" : " voxels are") +
                               " NaN: taken as outside");
    if (large_.count() > 0) {
        volume.notes.push_back(std::to_string(large_.count()) + (large_.count() == 1 ? " label has" : " labels have") +
                               " more than 32 bits: numbered anew, with the file's numbers as names");
        volume.label_names = std::move(large_).names();
    }
    // For few values, even a few runs may take more than an array.
    if (bytes_of_runs() && !are_runs_worth_it(0.0) && bytes_to_be(smallest_kind()) <= keeping_.memory_bytes)
        move_to(smallest_kind());
    volume.size = size_;
    volume.voxels = std::move(voxels_);
    volume.minimum = least_;
    volume.maximum = most_;
    volume.threshold = keeping_.threshold;
}

} // namespace ramus::volume
