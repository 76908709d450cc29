// SharedPages: bytes that are written once and then read, by the process and by whoever maps them as well. Another
// mapping may be written: what is written there is its own from then on, in whole pages of the system, and all else
// takes memory once. So a copy that differs in little costs little.
#pragma once

#include <cstddef>
#include <memory>

namespace ramus {

class SharedPages {
public:
    // At least so many bytes, all of them 0; null: the system has none of the kind.
    [[nodiscard]] static std::shared_ptr<const SharedPages> make(std::size_t bytes);
    SharedPages(const SharedPages&) = delete;
    SharedPages& operator=(const SharedPages&) = delete;
    ~SharedPages();

    // To be written by who made them, before anybody else maps them.
    [[nodiscard]] std::byte* data() const { return data_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; } // whole pages

    // The same bytes, to be read and written by somebody else, until munmap() of bytes(); they outlast this. Null: the
    // system does not map more.
    [[nodiscard]] void* mapped_again() const;
    // Until bytes are read here the next time, they do not count as this mapping's.
    void rest() const;

private:
    SharedPages(int file, std::byte* data, std::size_t bytes) : file_(file), data_(data), bytes_(bytes) {}

    int file_;
    std::byte* data_;
    std::size_t bytes_;
};

} // namespace ramus
