// VoxelStore: takes the values of a volume as they are read, of any type and some at a time. It keeps them as runs of
// equal ones as long as these take less than values one by one, then in the smallest type that holds all so far. Values
// that do not fit any more move what is there to a larger type.
#pragma once

#include "core/base/error.h"
#include "core/volume/large_labels.h"
#include "core/volume/volume.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::volume {

// What a file says of its values: value = slope * number + intercept.
struct Scaling {
    double slope = 1.0, intercept = 0.0;
    [[nodiscard]] bool none() const { return slope == 1.0 && intercept == 0.0; }
};

class VoxelStore {
public:
    // Room for `size` values, which takes no memory until they come. `memory_bytes`: most that they may take.
    VoxelStore(const glm::ivec3& size, double memory_bytes, std::string name);

    // The next values. NaN is outside: it becomes 0, or the least value where that is less. Fails on what is infinite
    // or cannot be kept, naming the voxel.
    template <class Raw> [[nodiscard]] Result<void> append(const Raw* raw, std::size_t count, const Scaling& scaling);

    // After the last one, of a file that can hold NaN. Fails where all are NaN, and where it takes too much memory.
    [[nodiscard]] Result<void> settle_nan();
    // All of them, with their range, and a note of how many were NaN.
    void finish(Volume& volume) &&;

private:
    struct Range {
        double least, most;
        bool whole, finite;
    };
    enum class Kind { kUint8, kUint16, kInt16, kInt32, kFloat }; // in the order of Voxels' arrays

    template <class Value> [[nodiscard]] Range range_of(const Value* values, std::size_t count) const;
    // As many of them, from the first on, as can be kept as runs and are worth it.
    template <class Raw> [[nodiscard]] std::size_t put_runs(const Raw* raw, std::size_t count, const Scaling& scaling);
    template <class Runs, class Raw>
    [[nodiscard]] std::size_t put_runs_in(Runs& runs, const Raw* raw, std::size_t count, const Scaling& scaling);
    [[nodiscard]] std::optional<double> bytes_of_runs() const; // none: values are in an array
    [[nodiscard]] bool are_runs_worth_it(double slack_bytes) const;
    template <class Value> [[nodiscard]] Result<void> put(const Value* values, std::size_t count);
    template <class Raw> [[nodiscard]] Result<std::vector<std::int32_t>> in_32_bits(const Raw* raw, std::size_t count);
    [[nodiscard]] Result<void> make_room_for(const Range& range, bool exact);
    [[nodiscard]] Kind smallest_kind() const;
    [[nodiscard]] double bytes_to_be(Kind kind) const;
    [[nodiscard]] Result<void> check_memory(double bytes) const;
    void move_to(Kind kind);
    template <class To> void move_to_array();
    // The values with 0 for NaN, scaled.
    template <class Raw>
    [[nodiscard]] std::vector<double> without_nan(const Raw* raw, std::size_t count, const Scaling& scaling);
    [[nodiscard]] std::string voxel_name(std::size_t at) const;

    glm::ivec3 size_;
    std::size_t total_, used_ = 0;
    double memory_bytes_;
    std::string name_;
    Voxels voxels_;
    double least_ = 0.0, most_ = 0.0;
    bool whole_ = true;
    struct Stretch {
        std::size_t begin, end;
    };
    std::vector<Stretch> nan_; // ascending
    std::size_t nan_count_ = 0;
    LargeLabels large_; // of whole numbers that may have more than 32 bits
};

} // namespace ramus::volume
