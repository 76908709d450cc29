#include "app/picture/organ_files.h"

#include "app/picture/colouring.h"
#include "app/session/colour_by.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/volumes/label_map_file.h"
#include "core/mesh/systems.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <utility>

namespace ramus::app {

namespace {

// The name as a part of a file's name: other than letters, digits and a few signs become "_".
std::string in_file_name(const std::string& name) {
    std::string text = name;
    for (char& letter : text)
        if (static_cast<unsigned char>(letter) < 128 && std::isalnum(static_cast<unsigned char>(letter)) == 0 &&
            std::string_view(" -_.@").find(letter) == std::string_view::npos)
            letter = '_';
    return text;
}

// liver.stl and "branch 7": "liver-branch 7.stl", with a number if that is taken.
std::string file_of(const std::filesystem::path& pattern, const std::string& name, std::set<std::string>& taken) {
    const std::string stem = pattern.stem().string() + "-" + in_file_name(name);
    std::string file = stem;
    for (int n = 2; !taken.insert(file).second; ++n) file = stem + "-" + std::to_string(n);
    return (pattern.parent_path() / (file + pattern.extension().string())).string();
}

// Parts are written as systems, whose names and colours files can hold, of one branch each.
io::MeshNames names_of(const OrganParts& parts) {
    io::MeshNames all;
    all.name = "territories";
    all.by = io::PartsBy::kSystem;
    all.claims = parts.claims;
    for (std::size_t n = 0; n < parts.names.size(); ++n) {
        const io::Colour colour = bytes_of(parts.colours[n]);
        all.systems.push_back({parts.names[n], colour});
        all.branches.push_back({parts.names[n], colour, static_cast<int>(n)});
    }
    return all;
}

} // namespace

OrganParts parts_of(const organ::Organ& organ, const tree::Claims& claims, std::vector<std::string> names) {
    OrganParts parts{organ, claims, std::move(names), {}};
    for (std::size_t n = 0; n < parts.names.size(); ++n) parts.colours.push_back(label_colour(n));
    return parts;
}

Result<void> write_organ_labels(const OrganParts& parts, const std::function<std::uint16_t(std::size_t)>& part_of,
                                const std::filesystem::path& file, const JobRange& job) {
    const organ::Organ& organ = parts.organ;
    io::LabelMap map{organ.size(), organ.to_patient(), parts.claims, {}, {}};
    for (std::size_t n = 0; n < parts.names.size(); ++n)
        map.names.push_back({static_cast<std::int32_t>(n + 1), parts.names[n], bytes_of(parts.colours[n])});
    const auto across = static_cast<std::size_t>(organ.size().x);
    map.fill_slice = [&](int k, std::span<std::uint16_t> labels) {
        organ.for_voxels({0, 0, k}, {organ.size().x, organ.size().y, k + 1},
                         [&](const glm::ivec3& voxel, std::size_t number) {
                             labels[static_cast<std::size_t>(voxel.y) * across + static_cast<std::size_t>(voxel.x)] =
                                 part_of(number);
                         });
    };
    return io::write_label_map(map, file, job);
}

Result<std::vector<PartSurface>> write_organ_surfaces(const OrganParts& parts, std::vector<mesh::TriangleMesh> surfaces,
                                                      const std::filesystem::path& file) {
    RAMUS_TRY(format, io::mesh_format(file));
    const bool together = io::has_names(*format);
    std::vector<PartSurface> written;
    std::set<std::string> taken;
    mesh::TriangleMesh all;
    for (std::size_t n = 0; n < surfaces.size(); ++n) {
        mesh::TriangleMesh& one = surfaces[n];
        if (one.triangles.empty()) continue;
        const std::string& name = parts.names[n];
        written.push_back({name, together ? file.string() : file_of(file, name, taken), one.triangles.size()});
        if (together) {
            one.branches.assign(one.positions.size(), static_cast<std::int32_t>(n));
            mesh::append(all, std::move(one));
            continue;
        }
        io::MeshNames of_one;
        of_one.name = name;
        of_one.colour = bytes_of(parts.colours[n]);
        of_one.claims = parts.claims;
        if (auto saved = io::write_mesh(std::move(one), written.back().file, of_one); !saved)
            return tl::unexpected(saved.error());
    }
    if (!all.triangles.empty())
        if (auto saved = io::write_mesh(std::move(all), file, names_of(parts)); !saved)
            return tl::unexpected(saved.error());
    return written;
}

} // namespace ramus::app
