#include "core/io/vtk/vtk_xml_data.h"

#include "core/base/words.h"
#include "core/io/inflate.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace ramus::io {

namespace {

constexpr const char* kGetVtkAgain = "the file is incomplete or damaged; get it again";

std::optional<NumberType> xml_type(std::string_view name) {
    constexpr std::pair<std::string_view, NumberType> kTypes[] = {
        {"Int8", NumberType::kInt8},      {"UInt8", NumberType::kUInt8},   {"Int16", NumberType::kInt16},
        {"UInt16", NumberType::kUInt16},  {"Int32", NumberType::kInt32},   {"UInt32", NumberType::kUInt32},
        {"Int64", NumberType::kInt64},    {"UInt64", NumberType::kUInt64}, {"Float32", NumberType::kFloat},
        {"Float64", NumberType::kDouble}, {"String", NumberType::kUInt8}};
    return paired(kTypes, name);
}

// Reads consecutive pieces of bytes, raw or in base64. Each piece of base64 has its own padding.
class EncodedBytes {
public:
    EncodedBytes(std::string_view data, bool base64) : data_(data), base64_(base64) {}

    // The next `count` bytes. None: there are fewer, or they are no base64.
    std::optional<std::string> take(std::uint64_t count) {
        if (count > (base64_ ? data_.size() / 4 * 3 + 3 : data_.size())) return std::nullopt;
        if (!base64_) {
            std::string bytes(data_.substr(0, count));
            data_.remove_prefix(count);
            return bytes;
        }
        if (held_.size() < count) {
            const std::optional<std::string> more = decode(count - held_.size());
            if (!more) return std::nullopt;
            held_ += *more;
        }
        if (held_.size() < count) return std::nullopt;
        std::string bytes = held_.substr(0, count);
        held_.erase(0, count);
        return bytes;
    }
    // The next byte begins a new piece.
    void next_piece() { held_.clear(); }

private:
    // Decodes whole groups of four digits, until there are `count` bytes.
    std::optional<std::string> decode(std::size_t count) {
        std::string bytes;
        while (bytes.size() < count && !data_.empty()) {
            // Because of padding, a group may have fewer than three bytes: decode, then continue if needed.
            std::size_t end = 0, digits = 0;
            const std::size_t wanted = (count - bytes.size() + 2) / 3 * 4;
            while (end < data_.size() && digits < wanted && data_[end] != '<') {
                const char c = data_[end++];
                if (c != ' ' && c != '\n' && c != '\r' && c != '\t') ++digits;
            }
            if (digits == 0) break;
            const auto part = base64_decoded(data_.substr(0, end), std::numeric_limits<std::size_t>::max());
            if (!part) return std::nullopt;
            bytes += *part;
            data_.remove_prefix(end);
        }
        return bytes;
    }

    std::string_view data_;
    bool base64_;
    std::string held_; // decoded, not taken
};

} // namespace

std::string VtkXmlData::place(const pugi::xml_node& node) const {
    const std::ptrdiff_t offset = node.offset_debug();
    return name_ + ":" + std::to_string(lines_.line(offset < 0 ? 0 : static_cast<std::size_t>(offset)));
}

Result<VtkXmlData> VtkXmlData::parse(std::string_view text, const std::string& name) {
    VtkXmlData data;
    data.text_ = text;
    data.name_ = name;
    data.document_ = std::make_unique<pugi::xml_document>();
    std::string head;
    const std::size_t tag = text.find("<AppendedData");
    if (tag != std::string_view::npos) {
        const std::size_t close = text.find('>', tag), begin = text.find('_', std::min(close, text.size()));
        if (begin == std::string_view::npos)
            return fail("the file ends where its data should begin", name + ":" + std::to_string(line_at(text, tag)),
                        kGetVtkAgain);
        data.appended_ = text.substr(begin + 1);
        data.appended_base64_ = text.substr(tag, close - tag).find("raw") == std::string_view::npos;
        head = std::string(text.substr(0, tag)) + "</VTKFile>";
    }
    const std::string_view xml = head.empty() ? text : std::string_view(head);
    data.lines_ = LineIndex(text.substr(0, tag));
    if (auto few = check_xml(xml, name); !few) return tl::unexpected(few.error());
    const pugi::xml_parse_result result = data.document_->load_buffer(xml.data(), xml.size());
    if (!result)
        return fail(std::string("this is not valid XML: ") + result.description(),
                    name + ":" + std::to_string(line_at(text, static_cast<std::size_t>(result.offset))), kGetVtkAgain);
    if (auto good = data.read_header(data.document_->child("VTKFile")); !good) return tl::unexpected(good.error());
    return data;
}

Result<void> VtkXmlData::read_header(const pugi::xml_node& root) {
    if (!root) return fail("there is no element VTKFile", name_, "this is not a file of VTK");
    if (std::string_view(root.attribute("byte_order").value()) == "BigEndian") order_ = std::endian::big;
    const std::string_view header = root.attribute("header_type").as_string("UInt32");
    if (header == "UInt64")
        header_ = NumberType::kUInt64;
    else if (header != "UInt32")
        return fail("the header type " + shown(header) + " is neither UInt32 nor UInt64", place(root), kGetVtkAgain);
    const std::string_view name = root.attribute("compressor").value();
    const auto compressor = vtk_compressor(name);
    if (!compressor)
        return fail("the data are compressed by " + shown(name), place(root),
                    "write the file anew with zlib, LZ4, LZMA or without compression");
    compressor_ = *compressor;
    return {};
}

Result<std::string> VtkXmlData::decoded(std::string_view data, bool base64, std::uint64_t most,
                                        const std::string& where) const {
    EncodedBytes bytes(data, base64);
    const auto header = [&](std::uint64_t count) -> std::optional<std::vector<std::int64_t>> {
        if (count > data.size()) return std::nullopt; // each takes more than a character
        const auto taken = bytes.take(count * size_of(header_));
        return taken ? std::optional(whole_numbers_in(*taken, header_, order_)) : std::nullopt;
    };
    const auto ends = [&] { return fail("the data of this array end too early", where, kGetVtkAgain); };
    const auto first = header(1);
    if (!first || first->front() < 0) return ends();
    if (compressor_ == VtkCompressor::kNone) {
        if (auto all = bytes.take(static_cast<std::uint64_t>(first->front()))) return std::move(*all);
        return ends();
    }
    const auto count = static_cast<std::uint64_t>(first->front());
    const auto sizes = header(2);
    if (!sizes) return ends();
    const auto packed = header(count);
    if (!packed) return ends();
    bytes.next_piece();
    std::string all;
    constexpr std::uint64_t kSmall = std::uint64_t{1} << 20; // for smaller arrays the reader has a better message
    most = std::max(most, kSmall);
    for (std::uint64_t b = 0; b < count; ++b) {
        const std::int64_t last = sizes->at(1), full = sizes->at(0);
        const std::int64_t size = b + 1 == count && last != 0 ? last : full, small = packed->at(b);
        if (size < 0 || small < 0 ||
            !can_grow_to(compressor_, static_cast<std::uint64_t>(small), static_cast<std::uint64_t>(size)))
            return fail("a block of this array claims a size that it cannot have", where, kGetVtkAgain);
        if (static_cast<std::uint64_t>(size) > most - all.size())
            return fail("this array holds more values than the file declares", where, kGetVtkAgain);
        // The sum over all arrays, because several may refer to the same bytes.
        unpacked_ += static_cast<std::uint64_t>(size);
        if (unpacked_ > inflation_limit(text_.size()))
            return fail("the compressed data grow, with this array, beyond " +
                            std::to_string(inflation_limit(text_.size()) >> 20) + " MiB",
                        where, "write the file anew without compression");
        const auto block = bytes.take(static_cast<std::uint64_t>(small));
        if (!block) return ends();
        const auto plain = unpacked_block(compressor_, *block, static_cast<std::uint64_t>(size));
        if (!plain) return fail("a compressed block of this array is damaged", where, kGetVtkAgain);
        all += *plain;
    }
    return all;
}

Result<std::string> VtkXmlData::bytes_of(const pugi::xml_node& array, std::uint64_t most) const {
    const std::string where = place(array);
    if (std::string_view(array.attribute("format").value()) == "appended") {
        const std::uint64_t offset = array.attribute("offset").as_ullong(std::numeric_limits<std::uint64_t>::max());
        if (offset >= appended_.size())
            return fail("the data of this array would lie beyond the end of the file", where, kGetVtkAgain);
        return decoded(appended_.substr(offset), appended_base64_, most, where);
    }
    return decoded(trimmed(array.child_value()), true, most, where);
}

namespace {

template <class T, class Read>
Result<std::vector<T>> text_values(std::string_view text, const std::string& where, const Read& read) {
    std::vector<T> values;
    const std::string no_name;
    WordScanner words(text, no_name);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const auto value = read(word);
        if (!value) return fail(shown(word) + " is not a number", where, "correct the file");
        values.push_back(*value);
    }
    return values;
}

bool is_text(const pugi::xml_node& array) {
    return std::string_view(array.attribute("format").as_string("ascii")) == "ascii";
}

Result<NumberType> type_of(const pugi::xml_node& array, const std::string& where) {
    const char* name = array.attribute("type").value();
    if (const auto type = xml_type(name)) return *type;
    return fail("the type " + shown(name) + " is not one of numbers", where, kGetVtkAgain);
}

} // namespace

Result<std::vector<double>> VtkXmlData::numbers(const pugi::xml_node& array, std::uint64_t most) const {
    if (is_text(array)) return text_values<double>(array.child_value(), place(array), to_real);
    RAMUS_TRY(type, type_of(array, place(array)));
    RAMUS_TRY(bytes, bytes_of(array, std::min(most, kAnyNumber) * size_of(type)));
    return numbers_in(bytes, type, order_);
}

Result<std::vector<std::int64_t>> VtkXmlData::whole_numbers(const pugi::xml_node& array, std::uint64_t most) const {
    if (is_text(array)) return text_values<std::int64_t>(array.child_value(), place(array), to_whole);
    RAMUS_TRY(type, type_of(array, place(array)));
    RAMUS_TRY(bytes, bytes_of(array, std::min(most, kAnyNumber) * size_of(type)));
    return whole_numbers_in(bytes, type, order_);
}

} // namespace ramus::io
