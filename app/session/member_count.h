// Counts the members of an aggregate at compile time, to check that a table of its members is complete. A test does so
// for the table of marks (marks_table.h).
#pragma once

#include <cstddef>

namespace ramus::app {

namespace details {
struct AnyMember {
    template <class T> operator T() const; // NOLINT(google-explicit-constructor,hicpp-explicit-conversions): the point
};
} // namespace details

// `T` must be an aggregate without C arrays and without nested aggregates that allow brace elision.
template <class T, class... Found> consteval std::size_t member_count() {
    if constexpr (requires { T{Found{}..., details::AnyMember{}}; })
        return member_count<T, Found..., details::AnyMember>();
    else
        return sizeof...(Found);
}

} // namespace ramus::app
