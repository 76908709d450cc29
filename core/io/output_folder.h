// OutputFolder: a folder for outputs. The destructor removes the folders that it created, if they are empty.
#pragma once

#include "core/base/error.h"
#include "core/base/leftovers.h"

#include <filesystem>
#include <vector>

namespace ramus::io {

class OutputFolder {
public:
    // Creates the folder and missing folders above it. Fails if they cannot be created, or `folder` is a file.
    [[nodiscard]] static Result<OutputFolder> make(const std::filesystem::path& folder);
    OutputFolder(OutputFolder&&) noexcept = default;
    OutputFolder& operator=(OutputFolder&&) = delete;
    ~OutputFolder();
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    explicit OutputFolder(std::filesystem::path path) : path_(std::move(path)) {}
    std::filesystem::path path_;
    std::vector<Leftover> made_; // the innermost last
};

} // namespace ramus::io
