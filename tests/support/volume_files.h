// Volumes that a test writes, and what reading them gives: the volume, or the message that says why not.
#pragma once

#include "core/io/volumes/volume_file.h"
#include "tests/support/nifti_file.h"
#include "tests/support/temporary_folder.h"

#include <cstring>
#include <doctest/doctest.h>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <zlib.h>

namespace ramus::test {

inline bool holds(const std::string& text, const char* words) {
    CAPTURE(text);
    return text.find(words) != std::string::npos;
}

struct VolumeFiles {
    std::string name; // "a.nii"
    TemporaryFolder folder = {};

    [[nodiscard]] Result<volume::Volume> read(const std::string& bytes, double memory = 0.0) const {
        Job job;
        return io::read_volume(write_plain(folder.path() / name, bytes), {memory}, job);
    }
    [[nodiscard]] volume::Volume good(const std::string& bytes) const {
        auto volume = read(bytes);
        REQUIRE_MESSAGE(volume, (volume ? "" : volume.error().message()));
        return std::move(*volume);
    }
    // The message, which names the file and says what to do.
    // NOLINTNEXTLINE(modernize-use-nodiscard): it checks, too
    std::string refusal(const std::string& bytes, double memory = 0.0) const {
        const auto volume = read(bytes, memory);
        REQUIRE_FALSE(volume);
        CHECK(volume.error().where.find(name) != std::string::npos);
        CHECK_FALSE(volume.error().hint.empty());
        return volume.error().what;
    }
};

// Numbers as they lie in memory, or in the other byte order.
template <class T> std::string bytes_of(const std::vector<T>& values, bool swapped = false) {
    std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    if (swapped)
        for (std::size_t n = 0; n < bytes.size(); n += sizeof(T))
            std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(n),
                         bytes.begin() + static_cast<std::ptrdiff_t>(n + sizeof(T)));
    return bytes;
}

enum class Wrapper { kZlib = 15, kGzip = 15 + 16 }; // zlib.h, deflateInit2

inline std::string compressed(const std::string& bytes, Wrapper wrapper) {
    z_stream stream{};
    REQUIRE(deflateInit2(&stream, 6, Z_DEFLATED, static_cast<int>(wrapper), 8, Z_DEFAULT_STRATEGY) == Z_OK);
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    std::string in = bytes;
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

// Where a voxel lies.
inline glm::dvec3 place(const volume::Volume& volume, const glm::dvec3& voxel) {
    return glm::dvec3(volume.to_patient * glm::dvec4(voxel, 1.0));
}

} // namespace ramus::test
