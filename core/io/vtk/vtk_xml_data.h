// Decodes the numbers of VTK's XML files in all encodings: text, inline base64, or appended as base64 or raw, with
// compressed blocks or not. Declared sizes are checked against the available bytes before memory is allocated.
#pragma once

#include "core/base/error.h"
#include "core/io/binary_numbers.h"
#include "core/io/vtk/vtk_blocks.h"
#include "core/io/xml_text.h"

#include <bit>
#include <cstdint>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

class VtkXmlData {
public:
    // Separates the appended data from the XML, and parses the XML. `text` must outlive this.
    [[nodiscard]] static Result<VtkXmlData> parse(std::string_view text, const std::string& name);

    [[nodiscard]] const pugi::xml_document& document() const { return *document_; }
    // The place of an element in messages: "liver.vtp:12".
    [[nodiscard]] std::string place(const pugi::xml_node& node) const;

    // The values of a DataArray. If it is compressed, fails before more than `most` values, and more than 1 MiB, are
    // decompressed. Otherwise the caller must check the number of values.
    static constexpr std::uint64_t kAnyNumber = std::uint64_t{1} << 58;
    [[nodiscard]] Result<std::vector<double>> numbers(const pugi::xml_node& array,
                                                      std::uint64_t most = kAnyNumber) const;
    [[nodiscard]] Result<std::vector<std::int64_t>> whole_numbers(const pugi::xml_node& array,
                                                                  std::uint64_t most = kAnyNumber) const;

private:
    VtkXmlData() = default;
    [[nodiscard]] Result<void> read_header(const pugi::xml_node& root);
    [[nodiscard]] Result<std::string> bytes_of(const pugi::xml_node& array, std::uint64_t most) const;
    [[nodiscard]] Result<std::string> decoded(std::string_view data, bool base64, std::uint64_t most,
                                              const std::string& where) const;

    std::string_view text_;
    std::string name_;
    LineIndex lines_; // of the XML
    std::unique_ptr<pugi::xml_document> document_;
    std::string_view appended_;
    bool appended_base64_ = false;
    std::endian order_ = std::endian::little;
    NumberType header_ = NumberType::kUInt32;
    VtkCompressor compressor_ = VtkCompressor::kNone;
    mutable std::uint64_t unpacked_ = 0; // declared size of all compressed blocks so far, in bytes
};

} // namespace ramus::io
