// ScratchFolder: a temporary folder that is removed, with its content, when the object is destroyed (leftovers.h).
#pragma once

#include "core/base/error.h"
#include "core/base/leftovers.h"

#include <filesystem>

namespace ramus {

class ScratchFolder {
public:
    // A new folder in TMPDIR, or /tmp, that only this user can access.
    [[nodiscard]] static Result<ScratchFolder> create();
    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

private:
    explicit ScratchFolder(const std::filesystem::path& path) : folder_(path, LeftoverKind::kWholeFolder) {}
    Leftover folder_;
};

} // namespace ramus
