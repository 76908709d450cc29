#include "core/io/writing.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <unistd.h>

namespace ramus::io {

tl::unexpected<Error> write_error(const std::filesystem::path& target, int code) {
    const std::string where = target.string();
    switch (code) {
    case ENOSPC:
    case EDQUOT:
        return fail("the disk is full", where, "nothing was written; free some space or write to another disk");
    case EFBIG:
        return fail("the file would be larger than this system allows it to be", where,
                    "nothing was written; raise the limit (ulimit -f) or write less");
    case EACCES:
    case EPERM:
        return fail("no permission to write there", where, "choose another folder or change its permissions");
    case EROFS:
        return fail("the disk can only be read", where, "choose a folder on another disk");
    case ENAMETOOLONG:
        return fail("the file name is too long", where, "choose a shorter one");
    default:
        return fail("cannot be written: " + std::string(std::strerror(code)), where, "choose another place for it");
    }
}

int write_all(int descriptor, const std::byte* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t done = ::write(descriptor, bytes, count);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return done < 0 ? errno : ENOSPC;
        bytes += done;
        count -= static_cast<std::size_t>(done);
    }
    return 0;
}

} // namespace ramus::io
