// NIfTI files as tests want them, byte by byte after the standard (nifti1.h, nifti2.h), without the library that reads
// them. All fields can be set; what is not set says: three dimensions, uint8, an sform of 1 mm.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nifti/znzlib.h>
#include <span>
#include <string>
#include <vector>

namespace ramus::test {

enum class NiftiType {
    kUint8 = 2,
    kInt16 = 4,
    kInt32 = 8,
    kFloat32 = 16,
    kFloat64 = 64,
    kRgb = 128,
    kInt8 = 256,
    kUint16 = 512,
    kUint32 = 768,
    kInt64 = 1024,
    kUint64 = 1280,
    kComplex = 32,
    kFloat128 = 1536
};

struct NiftiFile {
    int version = 1;
    bool big_endian = false;
    std::array<std::int64_t, 8> dim{3, 1, 1, 1, 1, 1, 1, 1};
    int type = static_cast<int>(NiftiType::kUint8);
    std::array<double, 8> pixdim{1, 1, 1, 1, 1, 1, 1, 1};
    double slope = 0.0, intercept = 0.0;
    int units = 2; // mm
    int qform = 0, sform = 1;
    std::array<double, 3> quaternion{}, origin{};
    std::array<double, 12> rows{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    std::string magic = {}; // as the version has it unless set
    double offset = -1.0;   // right behind header and extension mark unless set
    std::string data;       // in this machine's byte order

    template <class T> void put(std::span<const T> values) {
        data.assign(reinterpret_cast<const char*>(values.data()), values.size_bytes());
        bytes_each_ = sizeof(T);
    }
    template <class T> void put(const std::vector<T>& values) { put(std::span<const T>(values)); }

    [[nodiscard]] std::string bytes() const {
        std::string out(version == 2 ? 544 : 352, '\0');
        const auto at = [&]<class T>(std::size_t place, T value) {
            std::memcpy(&out[place], in_order(value).data(), sizeof(T));
        };
        const double begin = offset < 0.0 ? static_cast<double>(out.size()) : offset;
        if (version == 2) {
            at(0, std::int32_t{540});
            std::memcpy(&out[4], magic.empty() ? "n+2\0\r\n\032\n" : magic.c_str(), magic.empty() ? 8 : 4);
            at(12, static_cast<std::int16_t>(type));
            for (std::size_t n = 0; n < 8; ++n) at(16 + 8 * n, dim[n]), at(104 + 8 * n, pixdim[n]);
            at(168, static_cast<std::int64_t>(begin));
            at(176, slope), at(184, intercept);
            at(344, std::int32_t{qform}), at(348, std::int32_t{sform});
            for (std::size_t n = 0; n < 3; ++n) at(352 + 8 * n, quaternion[n]), at(376 + 8 * n, origin[n]);
            for (std::size_t n = 0; n < 12; ++n) at(400 + 8 * n, rows[n]);
            at(500, std::int32_t{units});
        } else {
            const auto single = [&](std::size_t place, double value) { at(place, static_cast<float>(value)); };
            at(0, std::int32_t{348});
            for (std::size_t n = 0; n < 8; ++n)
                at(40 + 2 * n, static_cast<std::int16_t>(dim[n])), single(76 + 4 * n, pixdim[n]);
            at(70, static_cast<std::int16_t>(type));
            single(108, begin), single(112, slope), single(116, intercept);
            out[123] = static_cast<char>(units);
            at(252, static_cast<std::int16_t>(qform)), at(254, static_cast<std::int16_t>(sform));
            for (std::size_t n = 0; n < 3; ++n) single(256 + 4 * n, quaternion[n]), single(268 + 4 * n, origin[n]);
            for (std::size_t n = 0; n < 12; ++n) single(280 + 4 * n, rows[n]);
            std::memcpy(&out[344], magic.empty() ? "n+1" : magic.c_str(), 4);
        }
        if (begin > static_cast<double>(out.size()) && begin < 1e6) out.resize(static_cast<std::size_t>(begin), '\0');
        std::string values = data;
        if (big_endian)
            for (std::size_t n = 0; n + bytes_each_ <= values.size(); n += bytes_each_)
                std::reverse(values.begin() + static_cast<std::ptrdiff_t>(n),
                             values.begin() + static_cast<std::ptrdiff_t>(n + bytes_each_));
        return out + values;
    }

private:
    template <class T> [[nodiscard]] std::array<char, sizeof(T)> in_order(T value) const {
        std::array<char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), &value, sizeof(T));
        if (big_endian) std::ranges::reverse(bytes);
        return bytes;
    }
    std::size_t bytes_each_ = 1;
};

inline std::filesystem::path write_plain(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

inline std::filesystem::path write_gzip(const std::filesystem::path& path, const std::string& bytes) {
    znzFile file = znzopen(path.c_str(), "wb", 1);
    znzwrite(bytes.data(), 1, bytes.size(), file);
    Xznzclose(&file);
    return path;
}

} // namespace ramus::test
