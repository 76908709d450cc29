// SharedPages: bytes that are written once and then shared by copy-on-write copies. A write to a copy duplicates only
// the page that it touches, so a copy that differs little takes little memory.
#pragma once

#include <cstddef>
#include <memory>

namespace ramus {

class SharedPages {
public:
    // Maps at least `bytes` bytes, all 0. Null: `bytes` is 0, or the system cannot map them.
    [[nodiscard]] static std::shared_ptr<const SharedPages> make(std::size_t bytes);
    SharedPages(const SharedPages&) = delete;
    SharedPages& operator=(const SharedPages&) = delete;
    ~SharedPages();

    // Written by the creator only, before the first map_private_copy().
    [[nodiscard]] std::byte* data() const { return data_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; } // whole pages

    // Maps a copy-on-write copy for reading and writing. The caller owns it and ends it with munmap() of bytes(); it
    // may outlive this object. Null: the system cannot map it.
    [[nodiscard]] void* map_private_copy() const;
    // Drops the pages of this mapping from resident memory. The content stays; reading maps it again.
    void release_resident() const;

private:
    SharedPages(int file, std::byte* data, std::size_t bytes) : file_(file), data_(data), bytes_(bytes) {}

    int file_;
    std::byte* data_;
    std::size_t bytes_;
};

} // namespace ramus
