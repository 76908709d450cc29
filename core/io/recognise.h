// The one place that decides which format a file has: of a tree, a volume or a mesh. All commands and the window ask
// here, so that a file is the same thing to each of them. The order, over the tables of all formats (file_format.h):
// signatures from the surest kind (Certainty) to the weakest; the extension comes before those that are a mere
// likeness. Of signatures of one kind, those of trees come before those of volumes and of meshes, each in the order of
// its table. docs/FORMATS.md lists the order.
#pragma once

#include "core/io/file_format.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

struct TreeFormat;
struct VolumeFormat;
struct MeshFormat;

// One format, or none. Volumes may have a format that is known and not read. VTK's files hold trees or meshes, which
// their first bytes do not tell: both are set (is_mesh() reads on).
struct Recognised {
    const TreeFormat* tree = nullptr;
    const VolumeFormat* volume = nullptr;
    const MeshFormat* mesh = nullptr;
    bool by_content = false; // else by the name alone
    [[nodiscard]] explicit operator bool() const { return tree != nullptr || volume != nullptr || mesh != nullptr; }
};

// The first bytes of a file, uncompressed; empty: it cannot be read.
[[nodiscard]] std::string head_of(const std::filesystem::path& path);

// Of a file called `name` that begins with `head`, uncompressed.
[[nodiscard]] Recognised recognised(std::string_view head, const std::filesystem::path& name);

// Of what has no name and begins with `bytes`, compressed by gzip or not.
[[nodiscard]] Recognised recognised_alone(std::string_view bytes);

// Of the file or folder at `path`, compressed by gzip or not. Pipes can be read but once: they, and what cannot be
// read, are recognised by their names.
[[nodiscard]] Recognised recognised(const std::filesystem::path& path);

// The formats whose content tells, in the order in which they are tried, with what their signatures are worth; each
// signature once.
[[nodiscard]] std::vector<const FileFormat*> recognition_order();

} // namespace ramus::io
