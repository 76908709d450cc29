// How many members an aggregate has, counted by the compiler: a table of its members that lacks one does not compile.
#pragma once

#include <cstddef>

namespace ramus::app {

namespace details {
struct AnyMember {
    template <class T> operator T() const; // NOLINT(google-explicit-constructor,hicpp-explicit-conversions): the point
};
} // namespace details

// `T` is an aggregate whose members are no aggregates with braces left out, and no C arrays.
template <class T, class... Found> consteval std::size_t member_count() {
    if constexpr (requires { T{Found{}..., details::AnyMember{}}; })
        return member_count<T, Found..., details::AnyMember>();
    else
        return sizeof...(Found);
}

} // namespace ramus::app
