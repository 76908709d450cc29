// A folder of its own for files that nobody shall see, gone with all that is in it when the object goes.
#pragma once

#include "core/base/error.h"

#include <filesystem>

namespace ramus {

class ScratchFolder {
public:
    // Below TMPDIR, for this user alone.
    [[nodiscard]] static Result<ScratchFolder> create();
    ScratchFolder(ScratchFolder&& other) noexcept;
    ScratchFolder& operator=(ScratchFolder&&) = delete;
    ~ScratchFolder();
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
    std::filesystem::path path_; // empty: moved from
};

} // namespace ramus
