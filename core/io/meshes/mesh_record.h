// Records of binary mesh files, put together in memory before they are written.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace ramus::io {

static_assert(std::endian::native == std::endian::little, "PLY and STL are written as they lie in memory");

template <std::size_t Size> class Record {
public:
    template <class T> void put(const T& value) {
        std::memcpy(bytes_.data() + used_, &value, sizeof(T));
        used_ += sizeof(T);
    }
    template <class File> void write(File& file) {
        file.write(bytes_.data(), used_);
        used_ = 0;
    }

private:
    std::array<std::byte, Size> bytes_;
    std::size_t used_ = 0;
};

} // namespace ramus::io
