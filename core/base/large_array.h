// LargeArray: a std::vector for plain values that spends nothing on setting elements which will all be written before
// they are read (resize leaves them unset), and that asks for large pages where they pay: first touch of a page costs
// as much as filling it, and a page of 2 MB spares 511 of 512 such first touches.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ramus {

template <class T> class LargeAllocator {
public:
    using value_type = T;
    LargeAllocator() = default;
    template <class U> explicit(false) LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes < 2 * kPage) return std::allocator<T>().allocate(count);
        void* memory = ::operator new (bytes, std::align_val_t{kPage});
#ifdef __linux__
        madvise(memory, bytes, MADV_HUGEPAGE); // a hint only
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < 2 * kPage)
            std::allocator<T>().deallocate(memory, count);
        else
            ::operator delete (memory, std::align_val_t{kPage});
    }

    template <class U, class... Arguments> void construct(U* at, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0 || !std::is_trivially_copyable_v<U>)
            ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
    bool operator==(const LargeAllocator&) const = default;

private:
    static constexpr std::size_t kPage = std::size_t{2} << 20;
};

template <class T> using LargeArray = std::vector<T, LargeAllocator<T>>;

} // namespace ramus
