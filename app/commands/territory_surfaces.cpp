#include "app/commands/territory_surfaces.h"

#include "app/commands/progress.h"
#include "app/picture/colouring.h"
#include "app/session/colour_by.h"
#include "core/io/meshes/mesh_file.h"
#include "core/organ/label_surfaces.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

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

void append(mesh::TriangleMesh& all, const mesh::TriangleMesh& one, std::size_t part) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), one.positions.begin(), one.positions.end());
    all.normals.insert(all.normals.end(), one.normals.begin(), one.normals.end());
    all.branches.insert(all.branches.end(), one.positions.size(), static_cast<std::int32_t>(part));
    for (const glm::uvec3& triangle : one.triangles) all.triangles.push_back(triangle + first);
}

// Territories are written as systems, whose names and colours files can hold, of one branch each.
io::MeshNames names_of(const OrganCase& read, const std::vector<std::string>& names) {
    io::MeshNames all;
    all.name = "territories";
    all.by = io::PartsBy::kSystem;
    all.claims = read.claims;
    for (std::size_t n = 0; n < names.size(); ++n) {
        const io::Colour colour = bytes_of(label_colour(n));
        all.systems.push_back({names[n], colour});
        all.branches.push_back({names[n], colour, static_cast<int>(n)});
    }
    return all;
}

} // namespace

Result<void> check_surfaces_output(const std::string& file) {
    if (auto format = io::mesh_format(file); !format) return tl::unexpected(format.error());
    return {};
}

Result<std::vector<TerritorySurface>> write_territory_surfaces(const OrganCase& read,
                                                               const std::vector<std::string>& names,
                                                               std::span<const int> groups, const std::string& file) {
    RAMUS_TRY(format, io::mesh_format(file));
    RAMUS_TRY(surfaces,
              with_progress(
                  "surfaces",
                  [&](Job& job) { return organ::label_surfaces(read.organ, groups, JobRange(job, 0.0F, 1.0F)); },
                  kNothingWritten));
    std::vector<TerritorySurface> written;
    std::set<std::string> taken;
    mesh::TriangleMesh all;
    for (std::size_t n = 0; n < names.size(); ++n) {
        mesh::TriangleMesh one = organ::surface_of(surfaces, static_cast<int>(n));
        if (one.triangles.empty()) continue;
        const bool together = io::has_names(*format);
        written.push_back({names[n], together ? file : file_of(file, names[n], taken), one.triangles.size()});
        if (together) {
            append(all, one, n);
            continue;
        }
        io::MeshNames of_one;
        of_one.name = names[n];
        of_one.colour = bytes_of(label_colour(n));
        of_one.claims = read.claims;
        if (auto saved = io::write_mesh(std::move(one), written.back().file, of_one); !saved)
            return tl::unexpected(saved.error());
    }
    if (!all.triangles.empty())
        if (auto saved = io::write_mesh(std::move(all), file, names_of(read, names)); !saved)
            return tl::unexpected(saved.error());
    return written;
}

} // namespace ramus::app
