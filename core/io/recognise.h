// Recognises the format of a file: of a tree, a volume or a mesh. The only place that decides this, so all commands and
// the window agree.
//
// The order, over the tables of all formats (file_format.h): signatures of certainty kMark, then kHeader, then the
// extension, then signatures of certainty kLikeness. Among signatures of equal certainty, trees come before volumes and
// volumes before meshes, each in the order of its table. docs/FORMATS.md lists the order.
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

// One format, or none. A volume's format may be known but not readable. VTK's files hold trees or meshes, which their
// first bytes do not distinguish: then both are set, and is_mesh() (meshes/mesh_file.h) reads on.
struct Recognised {
    const TreeFormat* tree = nullptr;
    const VolumeFormat* volume = nullptr;
    const MeshFormat* mesh = nullptr;
    bool by_content = false; // false: by the name alone
    [[nodiscard]] explicit operator bool() const { return tree != nullptr || volume != nullptr || mesh != nullptr; }
};

// The first kHeadBytes bytes of a file, uncompressed. Empty: it cannot be read.
[[nodiscard]] std::string head_of(const std::filesystem::path& path);

// The format of a file called `name` that begins with `head`, uncompressed.
[[nodiscard]] Recognised recognised(std::string_view head, const std::filesystem::path& name);

// The format of data without a name that begin with `bytes`, compressed by gzip or not.
[[nodiscard]] Recognised recognised_alone(std::string_view bytes);

// The format of the file or folder at `path`, compressed by gzip or not. Pipes, which can be read only once, and files
// that cannot be read are recognised by their names.
[[nodiscard]] Recognised recognised(const std::filesystem::path& path);

// The formats with a signature, in the order in which recognised() tries them; each signature once.
[[nodiscard]] std::vector<const FileFormat*> recognition_order();

} // namespace ramus::io
