#include "core/io/volumes/tiff/tiff_layout.h"

#include <algorithm>
#include <cstring>
#include <unordered_set>
#include <utility>

namespace ramus::io {

namespace {

constexpr const char* kTiffAgain = "copy or write it again";
constexpr std::size_t kMostTiffPages = std::size_t{1} << 18;
constexpr std::uint64_t kMostTiffDescription = std::uint64_t{64} << 20;

// Bytes of a value, by the number of its type. 0: no known type.
constexpr std::array<std::uint8_t, 19> kBytesOfTiffType = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
constexpr std::uint16_t kRational = 5;

std::uint64_t tiff_number(std::string_view bytes, bool big_endian) {
    std::uint64_t number = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        const std::size_t at = big_endian ? n : bytes.size() - 1 - n;
        number = number << 8 | static_cast<std::uint8_t>(bytes[at]);
    }
    return number;
}

class TiffWalk {
public:
    TiffWalk(std::istream& stream, std::uint64_t size, const std::string& name) : stream_(stream), name_(name) {
        layout_.file_bytes = size;
    }

    Result<TiffLayout> run() {
        RAMUS_TRY(head, at(0, 8));
        layout_.big_endian = head[0] == 'M';
        layout_.big = tiff_number(head.substr(2, 2), layout_.big_endian) == 43;
        std::uint64_t next = tiff_number(head.substr(4, 4), layout_.big_endian);
        if (layout_.big) {
            if (tiff_number(head.substr(4, 2), layout_.big_endian) != 8)
                return fail("this BigTIFF has positions that are not of 8 bytes", name_, kTiffAgain);
            RAMUS_TRY(position, number_at(8, 8));
            next = position;
        }
        std::unordered_set<std::uint64_t> seen;
        while (next != 0) {
            if (!seen.insert(next).second)
                return fail("its chain of pages leads from page " + std::to_string(seen.size()) + " back to another",
                            name_, kTiffAgain);
            if (seen.size() > kMostTiffPages)
                return fail("it has more than 262,144 pages", name_, "write it as several files, or as OME-Zarr");
            RAMUS_TRY(after, page_at(next));
            next = after;
        }
        if (layout_.pages.empty()) return fail("it has no page", name_, kTiffAgain);
        return std::move(layout_);
    }

private:
    Result<std::string> at(std::uint64_t position, std::uint64_t bytes) {
        if (position > layout_.file_bytes || bytes > layout_.file_bytes - position)
            return fail("the file ends before all that its pages promise", name_, kTiffAgain);
        return bytes_at(stream_, position, bytes, name_);
    }
    Result<std::uint64_t> number_at(std::uint64_t position, std::uint64_t bytes) {
        RAMUS_TRY(text, at(position, bytes));
        return tiff_number(text, layout_.big_endian);
    }

    // Adds the page whose entries begin at `position`. Returns the position of the next page.
    Result<std::uint64_t> page_at(std::uint64_t position) {
        const std::uint64_t word = layout_.big ? 8 : 4; // bytes of positions and counts
        const std::uint64_t count_bytes = layout_.big ? 8 : 2, entry_bytes = 4 + 2 * word;
        RAMUS_TRY(count, number_at(position, count_bytes));
        constexpr std::uint64_t kMostEntries = 1'000; // known files have less than 200
        if (count > kMostEntries) return fail("a page claims " + std::to_string(count) + " tags", name_, kTiffAgain);
        RAMUS_TRY(entries, at(position + count_bytes, count * entry_bytes));
        TiffPage page;
        for (std::uint64_t n = 0; n < count; ++n) {
            const std::string_view entry = std::string_view(entries).substr(n * entry_bytes, entry_bytes);
            TiffField field;
            field.type = static_cast<std::uint16_t>(tiff_number(entry.substr(2, 2), layout_.big_endian));
            field.count = tiff_number(entry.substr(4, word), layout_.big_endian);
            if (field.type >= kBytesOfTiffType.size() || kBytesOfTiffType[field.type] == 0) continue;
            field.position = position + count_bytes + n * entry_bytes + 4 + word;
            if (field.count > word || bytes_of(field) > word)
                field.position = tiff_number(entry.substr(4 + word), layout_.big_endian);
            const auto tag = static_cast<std::uint16_t>(tiff_number(entry.substr(0, 2), layout_.big_endian));
            if (auto taken = take(page, tag, field); !taken) return tl::unexpected(taken.error());
        }
        constexpr std::uint64_t kCopyOrMask = 1 | 4;
        if ((page.kind & kCopyOrMask) != 0)
            ++layout_.left_out;
        else
            layout_.pages.push_back(page);
        return number_at(position + count_bytes + count * entry_bytes, word);
    }

    Result<void> take(TiffPage& page, std::uint16_t tag, const TiffField& field) {
        constexpr std::uint16_t kDescription = 270;
        if (std::uint64_t* number = number_of(page, tag)) {
            RAMUS_TRY(values, first_values(field, 1));
            if (!values.empty()) *number = values.front();
        } else if (tag == 282 || tag == 283) {
            return take_resolution(page, tag == 283 ? 1 : 0, field);
        } else if (tag == 273 || tag == 324) {
            page.offsets = field;
        } else if (tag == 279 || tag == 325) {
            page.counts = field;
        } else if (tag == kDescription && layout_.pages.empty() && layout_.description.empty()) {
            if (bytes_of(field) > kMostTiffDescription)
                return fail("its description has more than 64 MiB", name_, kTiffAgain);
            RAMUS_TRY(text, at(field.position, bytes_of(field)));
            layout_.description = text.substr(0, text.find('\0'));
        }
        const auto* known = std::ranges::find(kTiffDecodingTags, tag);
        if (known != kTiffDecodingTags.end())
            page.decoding[static_cast<std::size_t>(known - kTiffDecodingTags.begin())] = field;
        return {};
    }

    static std::uint64_t* number_of(TiffPage& page, std::uint16_t tag) {
        const std::array<std::pair<std::uint16_t, std::uint64_t*>, 15> numbers = {{{254, &page.kind},
                                                                                   {256, &page.width},
                                                                                   {257, &page.height},
                                                                                   {258, &page.bits},
                                                                                   {259, &page.compression},
                                                                                   {262, &page.photometric},
                                                                                   {266, &page.fill_order},
                                                                                   {274, &page.orientation},
                                                                                   {277, &page.samples},
                                                                                   {278, &page.rows_per_strip},
                                                                                   {296, &page.resolution_unit},
                                                                                   {317, &page.predictor},
                                                                                   {322, &page.tile_width},
                                                                                   {323, &page.tile_height},
                                                                                   {339, &page.sample_format}}};
        const auto* found = std::ranges::find(numbers, tag, [](const auto& each) { return each.first; });
        return found == numbers.end() ? nullptr : found->second;
    }

    // The first values of a field, at most `most`.
    Result<std::vector<std::uint64_t>> first_values(TiffField field, std::uint64_t most) {
        field.count = std::min(field.count, most);
        if (auto there = at(field.position, bytes_of(field)); !there) return tl::unexpected(there.error());
        return tiff_numbers(stream_, layout_, field, name_);
    }

    Result<void> take_resolution(TiffPage& page, std::size_t axis, const TiffField& field) {
        if (field.type != kRational || field.count < 1) return {};
        RAMUS_TRY(text, at(field.position, 8));
        const auto above = static_cast<double>(tiff_number(text.substr(0, 4), layout_.big_endian));
        const auto below = static_cast<double>(tiff_number(text.substr(4, 4), layout_.big_endian));
        if (!page.resolution) page.resolution.emplace();
        (*page.resolution)[axis] = below > 0.0 ? above / below : 0.0;
        return {};
    }

    std::istream& stream_;
    const std::string& name_;
    TiffLayout layout_;
};

} // namespace

bool is_tiff(std::string_view head) {
    using namespace std::string_view_literals;
    return head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv) || head.starts_with("II+\0"sv) ||
           head.starts_with("MM\0+"sv);
}

std::uint64_t bytes_of(const TiffField& field) {
    const std::uint64_t each = field.type < kBytesOfTiffType.size() ? kBytesOfTiffType[field.type] : 0;
    constexpr std::uint64_t kLargest = ~std::uint64_t{0};
    return each > 0 && field.count > kLargest / each ? kLargest : each * field.count;
}

Result<std::string> bytes_at(std::istream& stream, std::uint64_t position, std::uint64_t bytes,
                             const std::string& name) {
    std::string text(bytes, '\0');
    stream.clear();
    stream.seekg(static_cast<std::streamoff>(position));
    if (!stream.read(text.data(), static_cast<std::streamsize>(bytes)))
        return fail("reading stopped with an error", name, "check the medium");
    return text;
}

Result<std::string> tiff_bytes(std::istream& stream, const TiffField& field, const std::string& name) {
    return bytes_at(stream, field.position, bytes_of(field), name);
}

Result<std::vector<std::uint64_t>> tiff_numbers(std::istream& stream, const TiffLayout& layout, const TiffField& field,
                                                const std::string& name) {
    constexpr std::array<std::uint16_t, 6> kWholeTypes = {1, 3, 4, 13, 16, 18};
    if (std::ranges::find(kWholeTypes, field.type) == kWholeTypes.end())
        return fail("one of its tags is no whole number", name, kTiffAgain);
    if (field.position > layout.file_bytes || bytes_of(field) > layout.file_bytes - field.position)
        return fail("the file ends before all that its pages promise", name, kTiffAgain);
    RAMUS_TRY(text, tiff_bytes(stream, field, name));
    const std::size_t each = kBytesOfTiffType[field.type];
    std::vector<std::uint64_t> numbers(field.count);
    for (std::size_t n = 0; n < numbers.size(); ++n)
        numbers[n] = tiff_number(std::string_view(text).substr(n * each, each), layout.big_endian);
    return numbers;
}

Result<TiffLayout> tiff_layout(const StoredBytes& file) {
    RAMUS_TRY(size, file.size());
    RAMUS_TRY(stream, file.open());
    return TiffWalk(*stream, size, file.name).run();
}

} // namespace ramus::io
