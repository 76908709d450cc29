#include "core/io/standard_input.h"

#include "core/base/descriptor.h"
#include "core/io/recognise.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace ramus::io {

namespace {

constexpr const char* kName = "standard input";

// Reads up to `bytes` bytes; fewer only at the end. -1: failed, with errno set.
ssize_t read_full(char* into, std::size_t bytes) {
    std::size_t done = 0;
    while (done < bytes) {
        const ssize_t got = ::read(STDIN_FILENO, into + done, bytes - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return static_cast<ssize_t>(done);
}

Result<void> copy_to(int file, const std::string& folder) {
    std::vector<char> buffer(std::size_t{1} << 18);
    for (std::uint64_t done = 0;;) {
        const ssize_t got = read_full(buffer.data(), buffer.size());
        if (got < 0)
            return fail(std::string("cannot be read: ") + std::strerror(errno), kName, "name a file, or use a pipe");
        const auto count = static_cast<std::size_t>(got);
        if (done == 0 && count == 0) return fail("is empty", kName, "check the program before the pipe");
        // Checked after the first block, so that gigabytes of an unknown format are not copied.
        if (done == 0 && !recognised_alone(std::string_view(buffer.data(), count)))
            return fail("its format is not recognised from its first bytes", kName,
                        "through a pipe come trees, masks and meshes that are recognised by their content; write it "
                        "to a file with its extension, and name that");
        done += count;
        if (done > kMostStandardInput)
            return fail("there is more than " + std::to_string(kMostStandardInput >> 30) + " GiB", kName,
                        "write it to a file, and name that");
        if (!write_all(file, {buffer.data(), count}))
            return fail(std::string("has no room in ") + folder + ": " + std::strerror(errno), kName,
                        "set TMPDIR to a folder with room, or write it to a file, and name that");
        if (count < buffer.size()) return {};
    }
}

} // namespace

bool is_standard_input(const std::filesystem::path& path) {
    for (const char* name : {kStandardInputPath, "/dev/fd/0", "/proc/self/fd/0"})
        if (path == name) return true;
    return false;
}

std::string input_name(const std::filesystem::path& path) { return is_standard_input(path) ? kName : path.string(); }

Result<void> settle_standard_input() {
    struct stat status {};
    if (::fstat(STDIN_FILENO, &status) != 0) return fail("is closed", kName, "name a file, or use a pipe");
    if (S_ISDIR(status.st_mode)) return fail("is a folder", kName, "name the folder instead of -");
    // Opening /dev/stdin again begins at the first byte, so a file that is read in part must be copied.
    if (S_ISREG(status.st_mode) && ::lseek(STDIN_FILENO, 0, SEEK_CUR) == 0) return {};
    if (::isatty(STDIN_FILENO) != 0)
        std::fputs("ramus: waiting for standard input; Ctrl-D ends it, Ctrl-C stops\n", stderr);
    std::error_code error;
    const std::filesystem::path above = std::filesystem::temp_directory_path(error);
    const std::string folder = error ? "/tmp" : above.string();
    const int file = open_without_name(folder);
    if (file < 0)
        return fail(std::string("cannot be kept in ") + folder + ": " + std::strerror(errno), kName,
                    "set TMPDIR to a folder that can be written to");
    auto copied = copy_to(file, folder);
    if (copied && ::dup2(file, STDIN_FILENO) < 0) copied = fail(std::strerror(errno), kName);
    ::close(file);
    return copied;
}

} // namespace ramus::io
