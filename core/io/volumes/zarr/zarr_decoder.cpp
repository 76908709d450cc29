#include "core/io/volumes/zarr/zarr_decoder.h"

#include "core/base/own_process.h"
#include "core/io/binary_numbers.h"
#include "core/io/inflate.h"

#include <blosc.h>
#include <string_view>
#include <utility>

namespace ramus::io {

namespace {

constexpr const char* kChunkAgain = "copy or write it again";

// `input`: the bytes of a decoded chunk, then each encoded chunk after its length. The answer: the decoded chunks. If
// one cannot be decoded, the answer ends before it.
std::string decode_blosc(std::string_view input) {
    const std::uint64_t chunk_bytes = take_number<std::uint64_t>(input).value_or(0);
    std::string decoded;
    while (const auto length = take_number<std::uint64_t>(input)) {
        const std::size_t begin = decoded.size();
        std::size_t bytes = 0;
        if (blosc_cbuffer_validate(input.data(), *length, &bytes) < 0 || bytes != chunk_bytes) break;
        decoded.resize(begin + chunk_bytes);
        const int got = blosc_decompress_ctx(input.data(), decoded.data() + begin, chunk_bytes, 1);
        if (got < 0 || static_cast<std::uint64_t>(got) != chunk_bytes) {
            decoded.resize(begin);
            break;
        }
        input.remove_prefix(*length);
    }
    return decoded;
}

tl::unexpected<Error> damaged_chunk(const std::string& name, const std::string& why) {
    return fail("a chunk " + why, name, kChunkAgain);
}

Result<std::vector<std::string>> decode_all_blosc(const ZarrArray& array, const std::vector<EncodedChunk>& chunks) {
    const std::uint64_t chunk_bytes = array.chunk_bytes();
    std::string input;
    append_number(input, chunk_bytes);
    std::vector<std::size_t> there;
    for (std::size_t n = 0; n < chunks.size(); ++n) {
        if (chunks[n].bytes.empty()) continue;
        if (chunks[n].bytes.size() < BLOSC_MIN_HEADER_LENGTH)
            return damaged_chunk(chunks[n].name, "is shorter than the header of blosc");
        there.push_back(n);
        append_number<std::uint64_t>(input, chunks[n].bytes.size());
        input += chunks[n].bytes;
    }
    std::vector<std::string> decoded(chunks.size());
    if (there.empty()) return decoded;
    ProcessLimits limits;
    limits.answer = chunk_bytes * there.size();
    limits.memory += 3 * limits.answer + input.size();
    const auto answer = run_in_own_process(decode_blosc, input, limits);
    const std::size_t whole = answer ? answer->size() / chunk_bytes : 0;
    if (whole < there.size())
        return damaged_chunk(chunks[there[whole]].name, "cannot be decoded with blosc, or does not hold the " +
                                                            std::to_string(chunk_bytes) + " bytes that the array says");
    for (std::size_t n = 0; n < there.size(); ++n) decoded[there[n]] = answer->substr(n * chunk_bytes, chunk_bytes);
    return decoded;
}

} // namespace

std::uint64_t most_chunk_file_bytes(const ZarrArray& array) {
    const std::uint64_t bytes = array.chunk_bytes();
    constexpr std::uint64_t kHeaders = std::uint64_t{1} << 16;
    // Numbers that cannot be compressed grow a little.
    return array.compressor == ZarrCompressor::kNone ? bytes : bytes + bytes / 8 + kHeaders;
}

Result<std::vector<std::string>> decode_chunks(const ZarrArray& array, std::vector<EncodedChunk> chunks) {
    if (array.compressor == ZarrCompressor::kBlosc) return decode_all_blosc(array, chunks);
    std::vector<std::string> decoded;
    for (EncodedChunk& chunk : chunks) {
        if (array.compressor == ZarrCompressor::kDeflate && !chunk.bytes.empty()) {
            auto inflated_bytes = inflated(chunk.bytes, array.chunk_bytes(), chunk.name);
            if (!inflated_bytes) return tl::unexpected(inflated_bytes.error());
            chunk.bytes = std::move(*inflated_bytes);
            if (chunk.bytes.empty()) return damaged_chunk(chunk.name, "is empty");
        }
        if (!chunk.bytes.empty() && chunk.bytes.size() != array.chunk_bytes())
            return damaged_chunk(chunk.name, "holds " + std::to_string(chunk.bytes.size()) +
                                                 " bytes, and the array says " + std::to_string(array.chunk_bytes()));
        decoded.push_back(std::move(chunk.bytes));
    }
    return decoded;
}

} // namespace ramus::io
