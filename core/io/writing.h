// Writing to descriptors, and what went wrong with it, told to a person.
#pragma once

#include "core/base/error.h"

#include <cstddef>
#include <filesystem>

namespace ramus::io {

// `code`: an errno.
[[nodiscard]] tl::unexpected<Error> write_error(const std::filesystem::path& target, int code);

// All of it, however many calls that takes. Returns 0, or the errno of the call that failed.
[[nodiscard]] int write_all(int descriptor, const std::byte* bytes, std::size_t count);

} // namespace ramus::io
