// VoxelStore: collects the values of a volume while a reader reads them, in pieces of any type. It stores runs of equal
// values while these take less memory than single values, then an array of the smallest type that holds all values so
// far. A value that does not fit converts the array to a larger type. The conversion releases the old array step by
// step, so that the values are in memory once.
//
//     VoxelStore store(size, {.memory_bytes = memory_left(0.0)}, name);
//     store.append(values, count, scaling);   // for all values, in order
//     store.settle_nan();                     // if the file can hold NaN
//     std::move(store).finish(volume);
#pragma once

#include "core/base/error.h"
#include "core/volume/large_labels.h"
#include "core/volume/volume.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::volume {

// The scaling that a file states: value = slope * number + intercept.
struct Scaling {
    double slope = 1.0, intercept = 0.0;
    [[nodiscard]] bool none() const { return slope == 1.0 && intercept == 0.0; }
};

// What a VoxelStore keeps.
struct Keeping {
    double memory_bytes = 0.0;            // limit for the values
    std::optional<double> threshold = {}; // keeps 1 for values of at least this one, 0 for others; none: keeps values
};

class VoxelStore {
public:
    // For a volume of `size` voxels; takes no memory yet. `name`: of the file, for errors. With a threshold, a scan
    // takes the memory of a mask.
    VoxelStore(const glm::ivec3& size, const Keeping& keeping, std::string name);

    // Appends values. NaN counts as outside: it becomes 0, or the least value if that is less. Fails, naming the voxel,
    // on infinite values and on values that cannot be stored.
    template <class Raw> [[nodiscard]] Result<void> append(const Raw* raw, std::size_t count, const Scaling& scaling);

    // Replaces NaN, after the last value. Fails if all values are NaN, and if it takes too much memory.
    [[nodiscard]] Result<void> settle_nan();
    // Moves the values and their range to `volume`, with a note of the number of NaN.
    void finish(Volume& volume) &&;

private:
    struct Range {
        double least, most;
        bool whole, finite;
    };
    enum class Kind { kUint8, kUint16, kInt16, kInt32, kFloat }; // in the order of Voxels' arrays

    // Whether values are at least the threshold: 1 or 0. NaN is not.
    template <class Raw>
    [[nodiscard]] Result<std::vector<std::uint8_t>> compared(const Raw* raw, std::size_t count, const Scaling& scaling);
    template <class Raw> [[nodiscard]] Result<void> add(const Raw* raw, std::size_t count, const Scaling& scaling);
    template <class Value> [[nodiscard]] Range range_of(const Value* values, std::size_t count) const;
    // Stores values as runs, from the first on, while possible and worthwhile. Returns their number.
    template <class Raw> [[nodiscard]] std::size_t put_runs(const Raw* raw, std::size_t count, const Scaling& scaling);
    template <class Runs, class Raw>
    [[nodiscard]] std::size_t put_runs_in(Runs& runs, const Raw* raw, std::size_t count, const Scaling& scaling);
    [[nodiscard]] std::optional<double> bytes_of_runs() const; // none: values are stored in an array
    [[nodiscard]] bool are_runs_worth_it(double slack_bytes) const;
    template <class Value> [[nodiscard]] Result<void> put(const Value* values, std::size_t count);
    template <class Raw> [[nodiscard]] Result<std::vector<std::int32_t>> in_32_bits(const Raw* raw, std::size_t count);
    [[nodiscard]] Result<void> make_room_for(const Range& range, bool exact);
    [[nodiscard]] Kind smallest_kind() const;
    [[nodiscard]] double bytes_to_be(Kind kind) const;
    [[nodiscard]] Result<void> check_memory(double bytes) const;
    void move_to(Kind kind);
    template <class To> void move_to_array();
    // The scaled values, with 0 for NaN.
    template <class Raw>
    [[nodiscard]] std::vector<double> without_nan(const Raw* raw, std::size_t count, const Scaling& scaling);
    [[nodiscard]] std::string voxel_name(std::size_t at) const;
    [[nodiscard]] tl::unexpected<Error> not_finite(std::size_t at) const;

    glm::ivec3 size_;
    std::size_t total_, used_ = 0;
    Keeping keeping_;
    std::string name_;
    Voxels voxels_;
    double least_ = 0.0, most_ = 0.0;
    bool whole_ = true;
    struct Stretch {
        std::size_t begin, end;
    };
    std::vector<Stretch> nan_; // ascending
    std::size_t nan_count_ = 0;
    LargeLabels large_; // for whole numbers of more than 32 bits
};

} // namespace ramus::volume
