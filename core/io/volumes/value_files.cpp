#include "core/io/volumes/value_files.h"

#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/text_numbers.h"
#include "core/io/volumes/byte_stage.h"
#include "core/io/volumes/header_text.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

namespace ramus::io {

namespace {

constexpr std::size_t kMostFiles = 65'536, kLongestName = 4096;

tl::unexpected<Error> too_many(const std::string& name) {
    return fail("its values are in more than 65,536 files", name, "write it as one file");
}

// Inserts a number into "slice%03d.raw". None: the pattern is not for a single whole number.
std::optional<std::string> numbered(std::string_view pattern, std::int64_t number) {
    const std::size_t percent = pattern.find('%');
    if (percent == std::string_view::npos) return std::nullopt;
    std::size_t at = percent + 1;
    const bool zeros = at < pattern.size() && pattern[at] == '0';
    std::size_t width = 0;
    for (; at < pattern.size() && pattern[at] >= '0' && pattern[at] <= '9'; ++at)
        width = 10 * width + static_cast<std::size_t>(pattern[at] - '0');
    constexpr std::size_t kWidest = 18;
    if (at == pattern.size() || (pattern[at] != 'd' && pattern[at] != 'i' && pattern[at] != 'u') || width > kWidest ||
        pattern.find('%', at) != std::string_view::npos)
        return std::nullopt;
    std::string digits = std::to_string(number);
    if (digits.size() < width) digits.insert(0, width - digits.size(), zeros ? '0' : ' ');
    return std::string(pattern.substr(0, percent)) + digits + std::string(pattern.substr(at + 1));
}

Result<std::vector<std::string>> names_of_pattern(const ByteSource& header, const std::string& field) {
    const auto refused = [&] {
        return fail("the names of its files make no sense: " + shown(field), header.name(),
                    "write a pattern of one number with its first, last and step, as slice%03d.raw 1 66 1");
    };
    std::vector<std::string_view> words;
    split_words(field, " \t", words);
    // An optional fourth number is the number of axes in a file. It follows from the sizes.
    if (words.size() < 4 || words.size() > 5) return refused();
    const auto first = parsed<std::int64_t>(words[1]), last = parsed<std::int64_t>(words[2]),
               step = parsed<std::int64_t>(words[3]);
    constexpr std::int64_t kLargest = 1'000'000'000;
    if (!first || !last || !step || *step == 0 || *first < 0 || *last < 0 || *first > kLargest || *last > kLargest ||
        std::abs(*step) > kLargest || (*last - *first) / *step < 0)
        return refused();
    const std::int64_t count = (*last - *first) / *step + 1;
    if (count > static_cast<std::int64_t>(kMostFiles)) return too_many(header.name());
    std::vector<std::string> names;
    for (std::int64_t n = 0; n < count; ++n) {
        auto name = numbered(words[0], *first + n * *step);
        if (!name) return refused();
        names.push_back(std::move(*name));
    }
    return names;
}

// Concatenates the files. Fails if one does not have exactly `each` bytes.
class FileListStage : public ByteStage {
public:
    FileListStage(std::vector<std::filesystem::path> files, std::uint64_t each, bool compressed)
        : files_(std::move(files)), each_(each), compressed_(compressed) {}

    Result<std::size_t> read(char* into, std::size_t bytes) override {
        if (left_ == 0) {
            if (next_ == files_.size()) return std::size_t{0};
            if (auto opened = open_next(); !opened) return tl::unexpected(opened.error());
        }
        auto got = source_->read_some(into, std::min<std::uint64_t>(bytes, left_));
        if (!got) return fail(of_file(got.error().what), {}, got.error().hint);
        if (*got == 0)
            return fail(of_file("ends before its " + std::to_string(each_) + " bytes"), {}, "copy or write it again");
        left_ -= *got;
        if (left_ == 0) {
            char more = 0;
            const auto behind = source_->read_some(&more, 1);
            if (!behind) return fail(of_file(behind.error().what), {}, behind.error().hint);
            if (*behind > 0)
                return fail(of_file("holds more than " + std::to_string(each_) + " bytes"), {}, "correct the header");
        }
        return got;
    }

private:
    [[nodiscard]] std::string of_file(const std::string& what) const {
        return files_[next_ - 1].filename().string() + ": " + what;
    }
    Result<void> open_next() {
        auto opened = ByteSource::open(files_[next_++], Unpack::kNothing);
        if (!opened) return fail(of_file(opened.error().what), {}, opened.error().hint);
        source_ = std::move(*opened);
        if (compressed_) source_->inflate_rest();
        left_ = each_;
        return {};
    }

    std::vector<std::filesystem::path> files_;
    std::uint64_t each_, left_ = 0;
    bool compressed_;
    std::size_t next_ = 0;
    std::optional<ByteSource> source_;
};

} // namespace

Result<std::vector<std::string>> listed_files(ByteSource& header, const std::string& field) {
    const bool is_list = lower_case(field) == "list" || lower_case(field).starts_with("list ");
    if (!is_list && field.find('%') != std::string::npos) return names_of_pattern(header, field);
    std::vector<std::string> names;
    if (!is_list) return names;
    std::string line;
    while (true) {
        RAMUS_TRY(more, header.read_line(line, kLongestName));
        if (!more) break;
        if (const std::string_view name = trimmed(line); !name.empty()) names.emplace_back(name);
        if (names.size() > kMostFiles) return too_many(header.name());
    }
    if (names.empty()) return fail("it lists no file of its values", header.name(), "write it as one file");
    return names;
}

Result<ByteSource> open_listed_values(const ByteSource& header, const std::vector<std::string>& names, double bytes,
                                      bool compressed) {
    const double each = bytes / static_cast<double>(names.size());
    constexpr double kWhole = 9e15;
    if (!(each >= 1.0 && each < kWhole) || each != static_cast<double>(static_cast<std::uint64_t>(each)))
        return fail("its values cannot be parted among " + std::to_string(names.size()) + " files", header.name(),
                    "correct the header: each file has as many slices");
    std::vector<std::filesystem::path> paths;
    double there = 0.0;
    for (const std::string& name : names) {
        RAMUS_TRY(path, values_path(header, name));
        std::error_code error;
        const auto size = static_cast<double>(std::filesystem::file_size(path, error));
        if (error || (!compressed && size != each))
            return fail(name + " should have " + std::to_string(static_cast<std::uint64_t>(each)) + " bytes, and has " +
                            (error ? "none" : std::to_string(static_cast<std::uint64_t>(size))),
                        header.name(), "correct the header, or copy the file again");
        there += size;
        paths.push_back(std::move(path));
    }
    auto stage = std::make_unique<FileListStage>(std::move(paths), static_cast<std::uint64_t>(each), compressed);
    constexpr double kDeflated = 1032.0; // largest ratio of gzip
    return ByteSource::of_stage(std::move(stage), header.name(), compressed ? kDeflated * there : there);
}

} // namespace ramus::io
