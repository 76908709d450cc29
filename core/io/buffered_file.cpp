#include "core/io/buffered_file.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <unistd.h>
#include <utility>

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
        return fail("the disk is read-only", where, "choose a folder on another disk");
    case ENAMETOOLONG:
        return fail("the file name is too long", where, "choose a shorter one");
    default:
        return fail("cannot be written: " + std::string(std::strerror(code)), where, "choose another place for it");
    }
}

BufferedFile::BufferedFile(int descriptor)
    : file_descriptor_(descriptor), buffer_(std::make_unique_for_overwrite<std::byte[]>(kBufferSize)) {}

BufferedFile::BufferedFile(BufferedFile&& other) noexcept
    : file_descriptor_(std::exchange(other.file_descriptor_, -1)), first_error_(other.first_error_),
      buffer_(std::move(other.buffer_)), used_(other.used_), flushed_(other.flushed_) {}

BufferedFile::~BufferedFile() {
    if (file_descriptor_ >= 0) ::close(file_descriptor_);
}

void BufferedFile::keep_error(int result) {
    if (result != 0 && first_error_ == 0) first_error_ = errno;
}

void BufferedFile::put(const std::byte* bytes, std::size_t count) {
    flushed_ += count;
    while (count > 0 && first_error_ == 0) {
        const ssize_t done = ::write(file_descriptor_, bytes, count);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) {
            first_error_ = done < 0 ? errno : ENOSPC;
            return;
        }
        bytes += done;
        count -= static_cast<std::size_t>(done);
    }
}

void BufferedFile::close() {
    flush();
    buffer_.reset();
    keep_error(::close(std::exchange(file_descriptor_, -1)));
}

void BufferedFile::flush() { put(buffer_.get(), std::exchange(used_, 0)); }

void BufferedFile::write_through(const void* bytes, std::size_t count) {
    flush();
    if (count > kBufferSize / 2) return put(static_cast<const std::byte*>(bytes), count);
    std::memcpy(buffer_.get(), bytes, count);
    used_ = count;
}

} // namespace ramus::io
