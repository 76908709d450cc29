// TIFF files that a test writes byte by byte, so that any tag and any position can be wrong.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ramus::test {

struct TiffFileText {
    bool big_endian = false, big = false; // byte order; BigTIFF

    struct Tag {
        std::uint16_t type = 4; // 2 text, 3 short, 4 long, 5 rational (two values each), 16 eight bytes
        std::vector<std::uint64_t> values;
        std::string text;
    };
    struct Page {
        std::map<std::uint16_t, Tag> tags;
        std::vector<std::string> strips; // set tags 273 and 279, unless those are there
        Page& set(std::uint16_t tag, std::uint16_t type, std::vector<std::uint64_t> values) {
            tags[tag] = {type, std::move(values), {}};
            return *this;
        }
        Page& describe(const std::string& text) {
            tags[270] = {2, {}, text + '\0'};
            return *this;
        }
    };
    std::vector<Page> pages;
    int back_to = -1; // the page that follows the last one; -1: none

    // A page of 8-bit numbers in one strip.
    Page& add(std::uint64_t width, std::uint64_t height, const std::string& pixels, std::uint64_t bits = 8) {
        Page page;
        page.set(256, 4, {width}).set(257, 4, {height}).set(258, 3, {bits}).set(259, 3, {1}).set(262, 3, {1});
        page.set(278, 4, {height});
        page.strips = {pixels};
        pages.push_back(page);
        return pages.back();
    }

    [[nodiscard]] std::string bytes() const {
        std::string file = big_endian ? "MM" : "II";
        put(file, big ? 43 : 42, 2);
        if (big) put(file, 8, 2), put(file, 0, 2);
        const std::size_t word = big ? 8 : 4;
        std::size_t link = file.size(); // where the position of the next page stands
        put(file, 0, word);
        std::vector<std::size_t> begins;
        for (Page page : pages) {
            std::vector<std::uint64_t> offsets, counts;
            for (const std::string& strip : page.strips) {
                offsets.push_back(file.size());
                counts.push_back(strip.size());
                file += strip;
            }
            if (!page.tags.contains(273) && !page.tags.contains(324)) page.set(273, 4, offsets);
            if (!page.tags.contains(279) && !page.tags.contains(325)) page.set(279, 4, counts);
            std::map<std::uint16_t, std::pair<std::uint64_t, std::string>> entries; // count, and value or position
            for (const auto& [number, tag] : page.tags) {
                std::string value = tag.text;
                for (const std::uint64_t each : tag.values)
                    put(value, each, tag.type == 3 ? 2 : tag.type == 16 ? 8 : 4);
                const std::uint64_t count = tag.type == 2 ? value.size() : tag.values.size() / (tag.type == 5 ? 2 : 1);
                if (value.size() > word) {
                    std::string position;
                    put(position, file.size(), word);
                    file += value;
                    value = position;
                }
                value.resize(word, '\0');
                entries[number] = {count, value};
            }
            begins.push_back(file.size());
            replace(file, link, file.size(), word);
            put(file, entries.size(), big ? 8 : 2);
            for (const auto& [number, entry] : entries) {
                put(file, number, 2);
                put(file, page.tags[number].type, 2);
                put(file, entry.first, word);
                file += entry.second;
            }
            link = file.size();
            put(file, 0, word);
        }
        if (back_to >= 0) replace(file, link, begins[static_cast<std::size_t>(back_to)], word);
        return file;
    }

private:
    void put(std::string& text, std::uint64_t number, std::size_t count) const {
        for (std::size_t n = 0; n < count; ++n)
            text += static_cast<char>(number >> (8 * (big_endian ? count - 1 - n : n)) & 0xFF);
    }
    void replace(std::string& text, std::size_t at, std::uint64_t number, std::size_t count) const {
        std::string digits;
        put(digits, number, count);
        text.replace(at, count, digits);
    }
};

} // namespace ramus::test
