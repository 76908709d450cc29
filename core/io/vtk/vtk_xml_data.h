// The numbers of VTK's XML files, however they are written: text, base64 in place, or appended to the end as base64 or
// raw, compressed block by block or not. Sizes that a file claims are believed only as far as there are bytes for them.
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
    // Cuts off what is appended behind the XML, and parses that. `text` must outlive this.
    [[nodiscard]] static Result<VtkXmlData> parse(std::string_view text, const std::string& name);

    [[nodiscard]] const pugi::xml_document& document() const { return *document_; }
    // "liver.vtp:12", where an element stands.
    [[nodiscard]] std::string place(const pugi::xml_node& node) const;

    // The values of a DataArray. Fails before more than `most` of them are decompressed, and more than a megabyte.
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
    mutable std::uint64_t unpacked_ = 0; // bytes that compressed blocks claim to be, so far
};

} // namespace ramus::io
