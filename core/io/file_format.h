// What every row of the tables of file formats says: of trees (trees/tree_file.h), of meshes (meshes/mesh_file.h) and
// of volumes (volumes/volume_file.h). Readers, writers, dialogs, messages and help texts go through the tables, so that
// a new format is a pair of files and a row. Which format a file has is decided in recognise.h alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// How surely a signature tells that a file has a format.
enum class Certainty : std::uint8_t {
    kMark,     // bytes that no other format has at that place
    kHeader,   // fields or words that say what kind of object the file holds
    kLikeness, // the file looks like one; its extension says more
};

struct FileFormat {
    std::string_view name;                    // "NIfTI"
    std::vector<std::string_view> extensions; // ".nii", ".nii.gz": lower case, the usual one first
    // Whether a file that begins with these bytes (uncompressed, up to kHeadBytes) is one; null: its content does not
    // tell.
    bool (*has_signature)(std::string_view head) = nullptr;
    Certainty certainty = Certainty::kMark; // of has_signature
    bool states_unit = false;               // else coordinates are taken as mm
    bool states_orientation = false;        // else axes are taken as RAS
    std::string_view help;                  // what is in such a file, in one sentence
};

inline constexpr std::size_t kHeadBytes = 4096;

// Of "liver.swc.gz" what "liver.swc" is called.
[[nodiscard]] std::filesystem::path without_gz(const std::filesystem::path& path);

// How long the longest of the format's extensions is that the name ends in, in capitals or not; 0: it has none of them.
[[nodiscard]] std::size_t extension_length(const std::filesystem::path& path, const FileFormat& format);

// "a, b or c".
[[nodiscard]] std::string listed(const std::vector<std::string_view>& words);

// The format whose extension `path` has, of several the longest: ".mrk.json" says more than ".json". Null: none.
template <class Format>
const Format* format_by_name(const std::vector<Format>& formats, const std::filesystem::path& path) {
    const Format* found = nullptr;
    std::size_t longest = 0;
    for (const Format& format : formats)
        if (const std::size_t length = extension_length(path, format); length > longest)
            found = &format, longest = length;
    return found;
}

// The extensions of the formats that are read; of those that are written.
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
