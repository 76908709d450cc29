// A folder for outputs. Folders that had to be made for it go again where nothing has come into them.
#pragma once

#include "core/base/error.h"
#include "core/base/leftovers.h"

#include <filesystem>
#include <vector>

namespace ramus::io {

class OutputFolder {
public:
    // With those above it. Fails where it cannot be made, or is a file.
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
