#include "core/io/inflate.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <zlib.h>

namespace ramus::io {

namespace {

struct EndInflate {
    void operator()(z_stream* stream) const { inflateEnd(stream); }
};

tl::unexpected<Error> damaged(const std::string& where, const char* what) {
    return fail(std::string("the compressed data ") + what, where, "the file is incomplete or damaged; get it again");
}

} // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b\x08"); }

std::uint64_t inflation_limit(std::uint64_t compressed) {
    return std::clamp<std::uint64_t>(compressed * 200, 16U << 20, 2048ULL << 20);
}

Result<std::string> inflated(std::string_view bytes, std::uint64_t limit, const std::string& where) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 32) != Z_OK) return damaged(where, "cannot be read");
    const std::unique_ptr<z_stream, EndInflate> ends(&stream);
    std::string text;
    std::array<char, 1 << 16> part{};
    while (true) {
        const std::size_t feed = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
        // zlib's interface lacks const; it does not write to its input.
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
        stream.avail_in = static_cast<uInt>(feed);
        stream.next_out = reinterpret_cast<Bytef*>(part.data());
        stream.avail_out = static_cast<uInt>(part.size());
        const int result = inflate(&stream, Z_NO_FLUSH);
        bytes.remove_prefix(feed - stream.avail_in);
        const std::size_t made = part.size() - stream.avail_out;
        if (text.size() + made > limit)
            return fail("the compressed data grow to more than " + std::to_string(limit >> 20) + " MiB", where,
                        "if it is a tree nevertheless, decompress it first");
        text.append(part.data(), made);
        if (result == Z_STREAM_END) {
            if (!is_gzip(bytes)) return text; // other bytes that follow are padding
            if (inflateReset(&stream) != Z_OK) return damaged(where, "cannot be read");
        } else if (result == Z_BUF_ERROR || (result == Z_OK && bytes.empty() && made == 0)) {
            return damaged(where, "end too early");
        } else if (result != Z_OK) {
            return damaged(where, "are damaged");
        }
    }
}

} // namespace ramus::io
