// LargeArray: a std::vector for plain values that spends nothing on setting elements which will all be written before
// they are read (resize leaves them unset). Its memory comes from TBB's allocator, which keeps what is given back for
// what any thread asks for next: a surface made anew is written where the one before it was.
#pragma once

#include <cstddef>
#include <new>
#include <oneapi/tbb/scalable_allocator.h>
#include <type_traits>
#include <utility>
#include <vector>

namespace ramus {

template <class T> class LargeAllocator : public tbb::scalable_allocator<T> {
public:
    LargeAllocator() = default;
    template <class U> explicit(false) LargeAllocator(const LargeAllocator<U>&) {}

    template <class U, class... Arguments> void construct(U* at, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0 || !std::is_trivially_copyable_v<U>)
            ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
};

template <class T> using LargeArray = std::vector<T, LargeAllocator<T>>;

} // namespace ramus
