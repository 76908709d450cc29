#include "core/io/temporary_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace ramus::io {

namespace fs = std::filesystem;

namespace {

// The folder of the target, whose disk must hold as much anyway; devices have no folder to write to.
fs::path folder_for(const fs::path& target) {
    std::error_code code;
    const fs::file_status status = fs::status(target, code);
    if (!code && fs::exists(status) && !fs::is_regular_file(status)) {
        const char* folder = std::getenv("TMPDIR");
        return folder != nullptr && *folder != 0 ? folder : "/var/tmp";
    }
    const fs::path folder = target.parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

int open_without_name(const fs::path& folder) {
#ifdef O_TMPFILE
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor >= 0) return descriptor;
#endif
    // Not every file system can do that: a name for a moment, then.
    std::string name = (folder / ".ramus-XXXXXX").string();
    const int named = ::mkostemp(name.data(), O_CLOEXEC);
    if (named >= 0) ::unlink(name.c_str());
    return named;
}

} // namespace

Result<TemporaryFile> TemporaryFile::create(const fs::path& target) {
    const int descriptor = open_without_name(folder_for(target));
    if (descriptor < 0) return write_error(target, errno);
    return TemporaryFile(target, descriptor);
}

TemporaryFile::TemporaryFile(fs::path target, int descriptor) : BufferedFile(descriptor), target_(std::move(target)) {}

void TemporaryFile::read(std::uint64_t offset, void* bytes, std::size_t count) {
    flush();
    auto* to = static_cast<std::byte*>(bytes);
    while (count > 0 && first_error_ == 0) {
        const ssize_t done = ::pread(file_descriptor_, to, count, static_cast<off_t>(offset));
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) {
            first_error_ = done < 0 ? errno : EIO;
            return;
        }
        to += done;
        offset += static_cast<std::uint64_t>(done);
        count -= static_cast<std::size_t>(done);
    }
}

void TemporaryFile::copy_to(BufferedFile& file) {
    const auto bytes = std::make_unique_for_overwrite<std::byte[]>(kBufferSize);
    for (std::uint64_t at = 0; at < size() && !failed(); at += kBufferSize) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kBufferSize, size() - at));
        read(at, bytes.get(), count);
        file.write(bytes.get(), count);
    }
}

Result<void> TemporaryFile::check() const {
    if (first_error_ != 0) return write_error(target_, first_error_);
    return {};
}

} // namespace ramus::io
