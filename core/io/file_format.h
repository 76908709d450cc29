// FileFormat: the common columns of the tables of file formats, for trees (trees/tree_file.h), meshes
// (meshes/mesh_file.h) and volumes (volumes/volume_file.h). Readers, writers, dialogs, messages and help texts use
// these tables, so a new format needs a reader or writer and a row. Only recognise.h decides which format a file has.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// How reliably a signature identifies a format, the most reliable first.
enum class Certainty : std::uint8_t {
    kMark,     // bytes that no other format has at that place
    kHeader,   // fields or words that say what kind of object the file holds
    kLikeness, // the file looks like one; its extension says more
};

struct FileFormat {
    std::string_view name;                    // "NIfTI"
    std::vector<std::string_view> extensions; // ".nii", ".nii.gz": lower case, the usual one first
    // Whether a file of this format begins with these bytes (uncompressed, up to kHeadBytes). Null: the content does
    // not identify the format.
    bool (*has_signature)(std::string_view head) = nullptr;
    Certainty certainty = Certainty::kMark; // of has_signature
    std::string_view help;                  // what is in such a file, in one sentence
};

inline constexpr std::size_t kHeadBytes = 4096;

// "liver.swc" for "liver.swc.gz"; other paths unchanged.
[[nodiscard]] std::filesystem::path without_gz(const std::filesystem::path& path);

// The length of the format's longest extension that the file name ends with, case-insensitive. 0: none.
[[nodiscard]] std::size_t extension_length(const std::filesystem::path& path, const FileFormat& format);

// "a, b or c".
[[nodiscard]] std::string listed(const std::vector<std::string_view>& words);

// The format with the longest extension that `path` ends with: ".mrk.json" wins over ".json". Null: none.
template <class Format>
const Format* format_by_name(const std::vector<Format>& formats, const std::filesystem::path& path) {
    const Format* found = nullptr;
    std::size_t longest = 0;
    for (const Format& format : formats)
        if (const std::size_t length = extension_length(path, format); length > longest)
            found = &format, longest = length;
    return found;
}

// The extensions of all formats that can be read, and of all that can be written.
template <class Format> std::vector<std::string_view> readable_extensions(const std::vector<Format>& formats) {
    std::vector<std::string_view> words;
    for (const Format& format : formats)
        if (is_read(format)) words.insert(words.end(), format.extensions.begin(), format.extensions.end());
    return words;
}
template <class Format> std::vector<std::string_view> writable_extensions(const std::vector<Format>& formats) {
    std::vector<std::string_view> words;
    for (const Format& format : formats)
        if (is_written(format)) words.insert(words.end(), format.extensions.begin(), format.extensions.end());
    return words;
}

} // namespace ramus::io
