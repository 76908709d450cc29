// The binary part of a page: compressed buffers one after the other, as base64 text. assets/page/decode.js reads them
// by number.
#pragma once

#include "app/reports/page/packed_mesh.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

class PageBlob {
public:
    std::size_t add(std::string_view compressed); // returns its number
    // The mesh as decode.js takes it.
    [[nodiscard]] nlohmann::ordered_json add(const PackedMesh& mesh);
    [[nodiscard]] nlohmann::ordered_json table() const; // of each buffer: its first byte and its size
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_; // base64; each buffer begins at a multiple of three bytes
    std::vector<std::pair<std::size_t, std::size_t>> buffers_;
};

// The bytes of numbers, low byte first.
template <class Number> [[nodiscard]] std::string deflated_numbers(std::span<const Number> numbers) {
    return deflated({reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size_bytes()});
}

} // namespace ramus::app
