#include "core/volume/voxel_store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <type_traits>
#include <utility>

namespace ramus::volume {

namespace {

// Adding and taking away a number whose last bit counts ones leaves whole numbers as they are, and no others below it.
template <class Value> bool is_whole(Value value) {
    constexpr Value kOnes = std::is_same_v<Value, float> ? Value(12582912.0) : Value(6755399441055744.0);
    constexpr Value kAllWhole = kOnes / 3;
    return (std::abs(value) >= kAllWhole) | ((value + kOnes) - kOnes == value);
}

std::string text_of(double whole) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.0f", whole);
    return text.data();
}

} // namespace

VoxelStore::VoxelStore(const glm::ivec3& size, double memory_bytes, std::string name)
    : size_(size),
      total_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z)),
      memory_bytes_(memory_bytes), name_(std::move(name)), voxels_(SparseArray<std::uint8_t>()) {
    std::get<0>(voxels_).resize(total_);
}

std::string VoxelStore::voxel_name(std::size_t at) const {
    const auto x = static_cast<std::size_t>(size_.x);
    const auto y = static_cast<std::size_t>(size_.y);
    return "voxel (" + std::to_string(at % x) + ", " + std::to_string(at / x % y) + ", " + std::to_string(at / x / y) +
           ")";
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

template <class To> void VoxelStore::move_to() {
    if (std::holds_alternative<SparseArray<To>>(voxels_)) return;
    SparseArray<To> larger;
    larger.resize(total_);
    std::visit([&](const auto& from) { copy_sparsely(from.data(), used_, larger.data()); }, voxels_);
    voxels_ = std::move(larger);
}

Result<void> VoxelStore::make_room_for(const Range& range, bool exact) {
    const bool first = used_ == 0;
    least_ = first ? range.least : std::min(least_, range.least);
    most_ = first ? range.most : std::max(most_, range.most);
    whole_ = whole_ && range.whole;
    const auto within = [&](double low, double high) { return whole_ && least_ >= low && most_ <= high; };
    Kind kind = Kind::kFloat;
    if (within(0, 255))
        kind = Kind::kUint8;
    else if (within(0, 65535))
        kind = Kind::kUint16;
    else if (within(-32768, 32767))
        kind = Kind::kInt16;
    else if (within(-2147483648.0, 2147483647.0))
        kind = Kind::kInt32;
    else if (exact)
        return fail("its whole numbers, up to " + text_of(std::abs(least_) > most_ ? least_ : most_) +
                        ", cannot be kept exactly",
                    name_, "number the labels anew, below 2147483648");
    if (kind == Kind::kFloat && std::max(std::abs(least_), std::abs(most_)) > std::numeric_limits<float>::max())
        return fail("its values leave single precision", name_, "scale them");
    constexpr std::array<double, 5> kBytes = {1, 2, 2, 4, 4};
    double bytes = kBytes[static_cast<std::size_t>(kind)] * static_cast<double>(total_);
    // While values move, they are there twice.
    if (static_cast<std::size_t>(kind) != voxels_.index())
        bytes += kBytes[voxels_.index()] * static_cast<double>(used_);
    if (bytes > memory_bytes_)
        return fail("the volume takes " + std::to_string(std::llround(bytes / 1e6)) + " MB of memory; " +
                        std::to_string(std::llround(memory_bytes_ / 1e6)) + " MB are left to it",
                    name_, "crop it, or allow more with --memory");
    constexpr std::array kMoves = {&VoxelStore::move_to<std::uint8_t>, &VoxelStore::move_to<std::uint16_t>,
                                   &VoxelStore::move_to<std::int16_t>, &VoxelStore::move_to<std::int32_t>,
                                   &VoxelStore::move_to<float>};
    (this->*kMoves[static_cast<std::size_t>(kind)])();
    return {};
}

template <class Value> Result<void> VoxelStore::put(const Value* values, std::size_t count) {
    const Range range = range_of(values, count);
    if (!range.finite) {
        const auto at = static_cast<std::size_t>(
            std::find_if(values, values + count, [](Value v) { return !std::isfinite(static_cast<double>(v)); }) -
            values);
        return fail("the value of " + voxel_name(used_ + at) + " is not finite", name_,
                    "replace it, by 0 if nothing was measured there");
    }
    if (auto room = make_room_for(range, std::is_integral_v<Value>); !room) return room;
    std::visit([&](auto& kept) { copy_sparsely(values, count, kept.data() + used_); }, voxels_);
    used_ += count;
    return {};
}

template <class Raw> Result<void> VoxelStore::append(const Raw* raw, std::size_t count, const Scaling& scaling) {
    if (count == 0) return {};
    if (scaling.none()) return put(raw, count);
    std::vector<double> values(count);
    for (std::size_t n = 0; n < count; ++n) values[n] = scaling.slope * static_cast<double>(raw[n]) + scaling.intercept;
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

void VoxelStore::finish(Volume& volume) && {
    volume.size = size_;
    volume.voxels = std::move(voxels_);
    volume.minimum = least_;
    volume.maximum = most_;
}

} // namespace ramus::volume
