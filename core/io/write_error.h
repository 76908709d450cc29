// What went wrong when something was written, told to a person.
#pragma once

#include "core/base/error.h"

#include <filesystem>

namespace ramus::io {

// `code`: an errno.
[[nodiscard]] tl::unexpected<Error> write_error(const std::filesystem::path& target, int code);

} // namespace ramus::io
