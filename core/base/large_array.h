// LargeArray: a std::vector for plain values whose resize() leaves new elements unset. The caller must write them
// before reading them. Its memory comes from TBB's allocator, which keeps freed memory for the next allocation of any
// thread: a new surface reuses the pages of the previous one. An array can have another ArrayMemory
// (core/base/disk_pages.h); the array and its copies then use it for allocations of more than 1 MiB.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <oneapi/tbb/scalable_allocator.h>
#include <type_traits>
#include <utility>
#include <vector>

namespace ramus {

// A source of memory for arrays. Must be thread-safe.
class ArrayMemory {
public:
    ArrayMemory() = default;
    ArrayMemory(const ArrayMemory&) = delete;
    ArrayMemory& operator=(const ArrayMemory&) = delete;
    virtual ~ArrayMemory() = default;
    [[nodiscard]] virtual void* allocate(std::size_t bytes) = 0; // throws if it has no memory
    virtual void deallocate(void* memory) noexcept = 0;
};

template <class T> class LargeAllocator {
public:
    using value_type = T;
    using is_always_equal = std::false_type;
    using propagate_on_container_copy_assignment = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;

    LargeAllocator() = default;
    explicit LargeAllocator(std::shared_ptr<ArrayMemory> memory) : memory_(std::move(memory)) {}
    template <class U> explicit(false) LargeAllocator(const LargeAllocator<U>& other) : memory_(other.memory()) {}

    [[nodiscard]] T* allocate(std::size_t count) {
        return is_elsewhere(count) ? static_cast<T*>(memory_->allocate(count * sizeof(T)))
                                   : tbb::scalable_allocator<T>().allocate(count);
    }
    void deallocate(T* memory, std::size_t count) noexcept {
        is_elsewhere(count) ? memory_->deallocate(memory) : tbb::scalable_allocator<T>().deallocate(memory, count);
    }
    template <class U, class... Arguments> void construct(U* at, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0 || !std::is_trivially_copyable_v<U>)
            ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
    [[nodiscard]] const std::shared_ptr<ArrayMemory>& memory() const { return memory_; }
    bool operator==(const LargeAllocator&) const = default;

private:
    static constexpr std::size_t kSmall = std::size_t{1} << 20; // bytes
    [[nodiscard]] bool is_elsewhere(std::size_t count) const {
        return memory_ != nullptr && count * sizeof(T) > kSmall;
    }

    std::shared_ptr<ArrayMemory> memory_; // null: that of TBB
};

template <class T> using LargeArray = std::vector<T, LargeAllocator<T>>;

} // namespace ramus
