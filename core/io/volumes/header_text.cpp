#include "core/io/volumes/header_text.h"

#include "core/io/input_file.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <system_error>

namespace ramus::io {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

template <class Number> std::optional<std::vector<Number>> all_numbers_in(std::string_view text) {
    std::vector<std::string_view> words;
    split_words(text, kBlanks, words);
    std::vector<Number> numbers;
    for (std::string_view word : words) {
        if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
        Number number{};
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || stop != word.data() + word.size()) return std::nullopt;
        numbers.push_back(number);
    }
    return numbers;
}

} // namespace

std::optional<std::vector<double>> numbers_in(std::string_view text) { return all_numbers_in<double>(text); }
std::optional<std::vector<std::int64_t>> whole_numbers_in(std::string_view text) {
    return all_numbers_in<std::int64_t>(text);
}

const std::string* HeaderText::find(std::initializer_list<const char*> names) const {
    for (const char* name : names)
        if (const auto field = fields.find(name); field != fields.end()) return &field->second;
    return nullptr;
}

tl::unexpected<Error> HeaderText::refused(const std::string& field, const std::string& why) const {
    return fail("the field \"" + field + "\" of its header " + why, file,
                "correct the header, or write the file again");
}

Result<std::optional<std::vector<double>>> HeaderText::numbers(std::initializer_list<const char*> names,
                                                               std::size_t count) const {
    const std::string* text = find(names);
    if (text == nullptr) return std::nullopt;
    auto numbers = numbers_in(*text);
    if (!numbers || numbers->size() != count)
        return refused(*names.begin(), "does not hold " + std::to_string(count) + " numbers");
    return numbers;
}

Result<std::optional<std::int64_t>> HeaderText::whole_number(std::initializer_list<const char*> names) const {
    const std::string* text = find(names);
    if (text == nullptr) return std::nullopt;
    const auto numbers = whole_numbers_in(*text);
    if (!numbers || numbers->size() != 1) return refused(*names.begin(), "is no whole number");
    return numbers->front();
}

Encoding binary_encoding(bool big_endian) {
    return big_endian == (std::endian::native == std::endian::big) ? Encoding::kBinary : Encoding::kSwapped;
}

Result<std::filesystem::path> values_path(const ByteSource& source, const std::string& name) {
    if (source.path().empty())
        return fail("its values are in another file, " + name, source.name(),
                    "name the header's file, or write header and values as one");
    const std::filesystem::path folder = std::filesystem::absolute(source.path()).parent_path().lexically_normal();
    const std::filesystem::path path = (folder / name).lexically_normal(); // an absolute name stays as it is
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        return fail("its values are in " + path.string() + ", and there is no such file", source.name(),
                    "put it there, beside the header");
    // Devices and pipes could provide bytes without end.
    if (!std::filesystem::is_regular_file(path, error))
        return fail("its values are in " + path.string() + ", which is no regular file", source.name(),
                    "correct the header");
    // A header of unknown origin must not read any file of this machine, not even through a link.
    const std::filesystem::path target = std::filesystem::canonical(path, error);
    const std::filesystem::path inside = std::filesystem::canonical(folder, error);
    if (error || *path.lexically_relative(folder).begin() == ".." || *target.lexically_relative(inside).begin() == "..")
        return fail("its values are said to be in " + (target.empty() ? path : target).string() +
                        ", outside of the header's folder",
                    source.name(), "put that file itself next to the header, and its name alone into it");
    return target;
}

Result<ByteSource> open_values(const ByteSource& source, const std::string& name) {
    RAMUS_TRY(path, values_path(source, name));
    return ByteSource::open(path, Unpack::kNothing);
}

} // namespace ramus::io
