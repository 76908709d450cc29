// LargeArray: a std::vector for plain values that spends nothing on setting elements which will all be written before
// they are read (resize leaves them unset), and that has pages of its own where it is long (pages.h).
#pragma once

#include "core/base/pages.h"

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace ramus {

template <class T> class LargeAllocator {
public:
    using value_type = T;
    LargeAllocator() = default;
    template <class U> explicit(false) LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t count) {
        if (count * sizeof(T) < kOwnPages) return std::allocator<T>().allocate(count);
        return static_cast<T*>(take_pages(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < kOwnPages)
            std::allocator<T>().deallocate(memory, count);
        else
            give_pages_back(memory, count * sizeof(T));
    }

    template <class U, class... Arguments> void construct(U* at, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0 || !std::is_trivially_copyable_v<U>)
            ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
    bool operator==(const LargeAllocator&) const = default;

private:
    static constexpr std::size_t kOwnPages = std::size_t{256} << 10; // bytes; below, memory is shared with others
};

template <class T> using LargeArray = std::vector<T, LargeAllocator<T>>;

} // namespace ramus
