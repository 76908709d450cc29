#include "core/base/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace ramus {

namespace fs = std::filesystem;

Result<ScratchFolder> ScratchFolder::create() {
    std::error_code error;
    const fs::path above = fs::temp_directory_path(error);
    std::string name = ((error ? fs::path("/tmp") : above) / "ramus-XXXXXX").string();
    const auto held = hold_leftovers();
    if (::mkdtemp(name.data()) == nullptr)
        return fail(std::string("no folder can be made there: ") + std::strerror(errno), name,
                    "set TMPDIR to a folder that can be written to");
    return ScratchFolder(name);
}

} // namespace ramus
