// A file that was read, and whether it has been written since.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace ramus::app {

struct FileStamp {
    std::filesystem::file_time_type written;
    std::uintmax_t bytes = 0;
    bool operator==(const FileStamp&) const = default;
};

// What the file held when it was read last, or why it could not be read.
template <class T> struct Loaded {
    FileStamp stamp;
    Result<std::shared_ptr<const T>> value;
};

// `before` while the file is as it was then, even if it could not be read; otherwise the result of `read()`, a
// Result<std::shared_ptr<const T>>. `before` may be null; `what` names the file's content in messages: "the lesion".
template <class T, class Read>
[[nodiscard]] Loaded<T> read_if_written(const std::filesystem::path& file, const Loaded<T>* before, const char* what,
                                        Read read) {
    std::error_code error;
    FileStamp stamp{std::filesystem::last_write_time(file, error), 0};
    if (!error) stamp.bytes = std::filesystem::file_size(file, error);
    if (error)
        return {{},
                fail(std::string(what) + " cannot be read: " + error.message(), file.string(),
                     "check the name and the folder")};
    if (before != nullptr && before->stamp == stamp) return *before;
    return {stamp, read()};
}

} // namespace ramus::app
