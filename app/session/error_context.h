// Errors of functions that do not know the file that they work on: the caller names it.
#pragma once

#include "core/base/error.h"
#include "core/io/standard_input.h"

#include <string>

namespace ramus::app {

// The same, and an error that does not say where names `file`.
template <class T> [[nodiscard]] Result<T> with_file(Result<T> result, const std::string& file) {
    if (!result && result.error().where.empty()) result.error().where = io::input_name(file);
    return result;
}

} // namespace ramus::app
