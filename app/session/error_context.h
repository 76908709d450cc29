// Adds the file's name to errors of functions that do not know the file they work on.
#pragma once

#include "core/base/error.h"
#include "core/io/standard_input.h"

#include <string>

namespace ramus::app {

// Returns `result`; an error without a place gets the name of `file`.
template <class T> [[nodiscard]] Result<T> with_file(Result<T> result, const std::string& file) {
    if (!result && result.error().where.empty()) result.error().where = io::input_name(file);
    return result;
}

} // namespace ramus::app
