// VoxelStore: takes the values of a volume as they are read, of any type and some at a time, and keeps them in the
// smallest type that holds all so far. Values that do not fit any more move what is there to a larger type.
#pragma once

#include "core/base/error.h"
#include "core/volume/volume.h"

#include <string>

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

    // The next values. Fails on what is not finite or cannot be kept, naming the voxel.
    template <class Raw> [[nodiscard]] Result<void> append(const Raw* raw, std::size_t count, const Scaling& scaling);

    // All of them, with their range.
    void finish(Volume& volume) &&;

private:
    struct Range {
        double least, most;
        bool whole, finite;
    };
    enum class Kind { kUint8, kUint16, kInt16, kInt32, kFloat }; // in the order of Voxels

    template <class Value> [[nodiscard]] Range range_of(const Value* values, std::size_t count) const;
    template <class Value> [[nodiscard]] Result<void> put(const Value* values, std::size_t count);
    [[nodiscard]] Result<void> make_room_for(const Range& range, bool exact);
    template <class To> void move_to();
    [[nodiscard]] std::string voxel_name(std::size_t at) const;

    glm::ivec3 size_;
    std::size_t total_, used_ = 0;
    double memory_bytes_;
    std::string name_;
    Voxels voxels_;
    double least_ = 0.0, most_ = 0.0;
    bool whole_ = true;
};

} // namespace ramus::volume
