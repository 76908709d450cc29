// The one way an output reaches the disk: written beside its target under another name, every write checked, flushed to
// the disk, and only then renamed over the target. Whatever fails, an older target stays as it was and nothing else is
// left behind. Devices and pipes (/dev/stdout) are written as they are, for there is nothing to rename.
//
// Failures on the way (a full disk, `ulimit -f`) are kept and told by commit(), so that writers need not ask at every
// number. One thread at a time per file.
#pragma once

#include "core/base/error.h"

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

namespace ramus::io {

// Can a file be made there? Asked before long work starts: fails when the folder is missing or not writable, or when
// `target` is a folder itself.
[[nodiscard]] Result<void> check_output(const std::filesystem::path& target);

class OutputFile {
public:
    [[nodiscard]] static Result<OutputFile> create(const std::filesystem::path& target);

    OutputFile(OutputFile&&) noexcept;
    OutputFile& operator=(OutputFile&&) noexcept;
    ~OutputFile(); // without commit(): as if nothing had been written

    void write(const void* bytes, std::size_t count) {
        if (count > kBufferSize - used_) return write_through(bytes, count);
        std::memcpy(buffer_.get() + used_, bytes, count);
        used_ += count;
    }
    void write(std::string_view text) { write(text.data(), text.size()); }

    // Puts the file in its place. The first error of any write is told here; the file is then gone.
    [[nodiscard]] Result<void> commit();

private:
    struct State;
    static constexpr std::size_t kBufferSize = std::size_t{1} << 20;

    explicit OutputFile(std::unique_ptr<State> state);
    void flush(const std::byte* bytes, std::size_t count);
    void write_through(const void* bytes, std::size_t count);

    std::unique_ptr<State> state_;
    std::unique_ptr<std::byte[]> buffer_;
    std::size_t used_ = 0;
};

// A whole file at once.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& target, std::string_view text);

// Removes what every OutputFile of this process has written so far and keeps further ones from starting. Safe in a
// signal handler; the process must end afterwards.
void remove_unfinished_files() noexcept;

} // namespace ramus::io
