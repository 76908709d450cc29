// TemporaryFile: bytes kept on the disk for a while, in a file without a name, so that nothing is left of it however
// the program ends. Written at its end, read anywhere. The first failure is returned by check().
#pragma once

#include "core/io/buffered_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace ramus::io {

class TemporaryFile : public BufferedFile {
public:
    // On the disk of `target`, the file that the bytes will end in and that messages name.
    [[nodiscard]] static Result<TemporaryFile> create(const std::filesystem::path& target);

    // `count` bytes from `offset` on, all of which have been written. Unset after a failure.
    void read(std::uint64_t offset, void* bytes, std::size_t count);
    // All of it, in order.
    void copy_to(BufferedFile& file);

    [[nodiscard]] Result<void> check() const;

private:
    TemporaryFile(std::filesystem::path target, int descriptor);

    std::filesystem::path target_;
};

} // namespace ramus::io
