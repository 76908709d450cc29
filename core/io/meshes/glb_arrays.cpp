#include "core/io/meshes/glb_arrays.h"

#include <cstdint>
#include <cstring>
#include <glm/vec4.hpp>
#include <meshoptimizer.h>

namespace ramus::io {

namespace {

// The extension's first version knows these encodings alone.
constexpr int kVertexVersion = 0, kIndexVersion = 1;

std::string encoded(const void* values, std::size_t count, std::size_t stride) {
    meshopt_encodeVertexVersion(kVertexVersion);
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    auto* const out = reinterpret_cast<unsigned char*>(bytes.data()); // bytes are what the library writes
    bytes.resize(meshopt_encodeVertexBuffer(out, bytes.size(), values, count, stride));
    return bytes;
}

// Each number, or each vector as a whole, as whole multiples of a power of two.
GlbArray exponential(const float* values, std::size_t count, std::size_t stride, int bits, void* unpacked) {
    std::vector<std::uint32_t> words(count * stride / sizeof(std::uint32_t));
    meshopt_encodeFilterExp(words.data(), count, stride, bits, values);
    GlbArray packed{count, stride, "EXPONENTIAL", encoded(words.data(), count, stride)};
    if (unpacked == nullptr) return packed;
    meshopt_decodeFilterExp(words.data(), count, stride);
    std::memcpy(unpacked, words.data(), count * stride);
    return packed;
}

} // namespace

GlbArray packed_positions(const std::vector<glm::vec3>& positions, std::vector<glm::vec3>& unpacked) {
    constexpr int kBits = 22; // one for the sign
    unpacked.resize(positions.size());
    return exponential(&positions.data()->x, positions.size(), sizeof(glm::vec3), kBits, unpacked.data());
}

GlbArray packed_normals(const std::vector<glm::vec3>& normals) {
    constexpr int kBits = 8;
    std::vector<glm::vec4> wide; // as the library takes them
    wide.reserve(normals.size());
    for (const glm::vec3& normal : normals) wide.emplace_back(normal, 0.0F);
    std::vector<std::uint32_t> words(normals.size());
    meshopt_encodeFilterOct(words.data(), words.size(), sizeof(std::uint32_t), kBits, &wide.data()->x);
    return {words.size(), sizeof(std::uint32_t), "OCTAHEDRAL",
            encoded(words.data(), words.size(), sizeof(std::uint32_t))};
}

GlbArray packed_numbers(const std::vector<float>& numbers) {
    constexpr int kBits = 16;
    return exponential(numbers.data(), numbers.size(), sizeof(float), kBits, nullptr);
}

GlbArray packed_whole_numbers(const std::vector<float>& numbers) {
    return {numbers.size(), sizeof(float), nullptr, encoded(numbers.data(), numbers.size(), sizeof(float))};
}

GlbArray packed_triangles(std::span<const glm::uvec3> triangles, std::size_t vertices) {
    meshopt_encodeIndexVersion(kIndexVersion);
    const std::size_t count = 3 * triangles.size();
    std::string bytes(meshopt_encodeIndexBufferBound(count, vertices), '\0');
    auto* const out = reinterpret_cast<unsigned char*>(bytes.data()); // bytes are what the library writes
    bytes.resize(meshopt_encodeIndexBuffer(out, bytes.size(), &triangles.data()->x, count));
    return {count, sizeof(std::uint32_t), nullptr, std::move(bytes)};
}

} // namespace ramus::io
