// A folder of its own for files that nobody shall see, gone with all that is in it when the object goes.
#pragma once

#include "core/base/error.h"
#include "core/base/leftovers.h"

#include <filesystem>

namespace ramus {

class ScratchFolder {
public:
    // Below TMPDIR, for this user alone.
    [[nodiscard]] static Result<ScratchFolder> create();
    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

private:
    explicit ScratchFolder(const std::filesystem::path& path) : folder_(path, LeftoverKind::kWholeFolder) {}
    Leftover folder_;
};

} // namespace ramus
