#include "core/io/meshes/glb.h"

#include "core/base/bounds.h"
#include "core/io/meshes/glb_arrays.h"
#include "core/io/meshes/mesh_sections.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace ramus::io {

static_assert(std::endian::native == std::endian::little, "GLB is written as it lies in memory");

namespace {

using Json = nlohmann::ordered_json;

// Numbers of the format.
constexpr int kFloat = 5126, kUnsigned = 5125, kByte = 5120; // component types
constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;  // targets
constexpr const char* kFeatures = "EXT_mesh_features";       // says which branch each vertex belongs to
constexpr const char *kCompression = "EXT_meshopt_compression", *kQuantized = "KHR_mesh_quantization";
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

double linear(std::uint8_t srgb) {
    const double c = srgb / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Json vector(const glm::vec3& v) { return {double(v.x), double(v.y), double(v.z)}; }

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

// The arrays of a compressed file, in the order of their bytes; empty: the mesh has none.
struct PackedArrays {
    GlbArray positions, normals, radii, features, triangles;
    std::vector<glm::vec3> seen; // the positions that readers see
    [[nodiscard]] std::array<const GlbArray*, 5> all() const {
        return {&positions, &normals, &radii, &features, &triangles};
    }
};

// Whether vertices have branches that are described.
bool of_vessels(const mesh::TriangleMesh& mesh, const MeshNames& names) {
    return !names.vessels.empty() && names_all(names, mesh.branches);
}

// The text of the file's first chunk, from the sections of the mesh: one for each part, in the order of their numbers.
class Scene {
public:
    // `packed`: null for a file that is not compressed.
    Scene(const mesh::TriangleMesh& mesh, const MeshNames& names, const MeshSections& cut, const PackedArrays* packed)
        : names_(names), cut_(cut), packed_(packed), has_normals_(!mesh.normals.empty()),
          has_radii_(!mesh.radii.empty()), has_features_(of_vessels(mesh, names)) {
        json_["asset"] = {{"version", "2.0"}, {"generator", "ramus " RAMUS_VERSION}};
        add_extensions();
        for (std::size_t id = 0; id < names.vessels.size(); ++id)
            if (const int parent = names.vessels[id].parent; parent >= 0) children_[parent].push_back(id);
        json_["scene"] = 0;
        json_["scenes"].push_back({{"name", names.name}, {"nodes", Json::array({0})}});
        // (x, y, z) of RAS becomes (-x, z, y) / 1000: half a turn about (0, 1, 1). That of LPS becomes (x, z, -y) /
        // 1000: a quarter of a turn about x.
        const double half = std::sqrt(0.5);
        const bool ras = names.axes == Orientation::ras();
        const std::string axes = axes_word(names.axes, names.claims);
        nodes_.push_back({{"name", names.name},
                          {"rotation", ras ? Json{0.0, half, half, 0.0} : Json{-half, 0.0, 0.0, half}},
                          {"scale", {0.001, 0.001, 0.001}},
                          {"extras", {{"units", names.claims.unit_word()}, {"orientation", axes}}}});
        add_views();
    }

    void add_part(std::size_t number) {
        if (cut_.sections[number].triangles == 0) return;
        switch (names_.by) {
        case PartsBy::kNone:
            nodes_[0]["mesh"] = mesh_of(number, names_.name, names_.colour, {});
            break;
        case PartsBy::kSystem: {
            const tree::System& system = names_.systems[number];
            Json node{{"name", system.name}, {"mesh", mesh_of(number, system.name, system.colour, number)}};
            if (has_features_) node["extras"] = {{"system", system.name}};
            add_node(0, std::move(node));
            break;
        }
        case PartsBy::kBranch: {
            const MeshNames::Branch& branch = names_.branches[number];
            std::optional<std::size_t> system;
            if (!names_.systems.empty()) system = static_cast<std::size_t>(branch.system);
            Json node{{"name", branch.name}, {"mesh", mesh_of(number, branch.name, branch.colour, system)}};
            if (has_features_) node["extras"] = extras_of(number);
            add_node(system ? node_of_system(*system) : 0, std::move(node));
            break;
        }
        }
    }

    [[nodiscard]] std::string text() && {
        json_["nodes"] = std::move(nodes_);
        json_["meshes"] = std::move(meshes_);
        json_["materials"] = std::move(materials_);
        json_["accessors"] = std::move(accessors_);
        json_["bufferViews"] = std::move(views_);
        Json plain{{"byteLength", bytes_}};
        if (packed_ != nullptr) {
            plain["extensions"][kCompression] = {{"fallback", true}}; // where a reader unpacks to
            json_["buffers"] = {{{"byteLength", packed_bytes_}}, std::move(plain)};
        } else {
            json_["buffers"] = Json::array({std::move(plain)});
        }
        // A name from a file may contain any bytes.
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        return text;
    }
    [[nodiscard]] std::uint64_t bytes() const { return packed_ != nullptr ? packed_bytes_ : bytes_; }

private:
    void add_extensions() {
        Json used = Json::array();
        if (has_features_) used.push_back(kFeatures);
        if (packed_ != nullptr) {
            used.push_back(kCompression);
            used.push_back(kQuantized);
            json_["extensionsRequired"] = {kCompression, kQuantized};
        }
        if (!used.empty()) json_["extensionsUsed"] = std::move(used);
    }

    int add_view(std::size_t count, std::size_t stride, int target, const GlbArray* packed) {
        Json view{{"buffer", packed != nullptr ? 1 : 0}, {"byteOffset", bytes_}, {"byteLength", count * stride}};
        if (target == kArrayBuffer) view["byteStride"] = stride;
        view["target"] = target;
        bytes_ += count * stride;
        if (packed != nullptr) {
            Json how{{"buffer", 0},
                     {"byteOffset", packed_bytes_},
                     {"byteLength", packed->bytes.size()},
                     {"byteStride", packed->stride},
                     {"count", packed->count},
                     {"mode", target == kArrayBuffer ? "ATTRIBUTES" : "TRIANGLES"}};
            if (packed->filter != nullptr) how["filter"] = packed->filter;
            view["extensions"][kCompression] = std::move(how);
            packed_bytes_ += padded(packed->bytes.size());
        }
        views_.push_back(std::move(view));
        return static_cast<int>(views_.size()) - 1;
    }

    void add_views() {
        const std::size_t vertices = cut_.vertices.size();
        const auto packed = [this](GlbArray PackedArrays::*array) {
            return packed_ != nullptr ? &(packed_->*array) : nullptr;
        };
        normal_bytes_ = packed_ != nullptr ? packed_->normals.stride : sizeof(glm::vec3);
        positions_ = add_view(vertices, sizeof(glm::vec3), kArrayBuffer, packed(&PackedArrays::positions));
        if (has_normals_) normals_ = add_view(vertices, normal_bytes_, kArrayBuffer, packed(&PackedArrays::normals));
        if (has_radii_) radii_ = add_view(vertices, sizeof(float), kArrayBuffer, packed(&PackedArrays::radii));
        if (has_features_) features_ = add_view(vertices, sizeof(float), kArrayBuffer, packed(&PackedArrays::features));
        indices_ = add_view(3 * cut_.triangles.size(), sizeof(std::uint32_t), kElementBuffer,
                            packed(&PackedArrays::triangles));
    }

    std::size_t add_accessor(int view, std::size_t offset, std::size_t count, int component, const char* type) {
        accessors_.push_back({{"bufferView", view},
                              {"byteOffset", offset},
                              {"componentType", component},
                              {"count", count},
                              {"type", type}});
        return accessors_.size() - 1;
    }

    std::size_t mesh_of(std::size_t number, const std::string& name, const Colour& colour,
                        std::optional<std::size_t> system) {
        const MeshSections::Section& section = cut_.sections[number];
        const auto of_vertices = [&](int view, std::size_t size, const char* type) {
            return add_accessor(view, size * section.first_vertex, section.vertices, kFloat, type);
        };
        Json attributes;
        attributes["POSITION"] = of_vertices(positions_, sizeof(glm::vec3), "VEC3");
        const Bounds<glm::vec3> box = bounds_of(section);
        accessors_.back()["min"] = vector(box.least);
        accessors_.back()["max"] = vector(box.most);
        if (has_normals_) {
            attributes["NORMAL"] = add_accessor(normals_, normal_bytes_ * section.first_vertex, section.vertices,
                                                packed_ != nullptr ? kByte : kFloat, "VEC3");
            if (packed_ != nullptr) accessors_.back()["normalized"] = true;
        }
        if (has_radii_) attributes["_RADIUS"] = of_vertices(radii_, sizeof(float), "SCALAR");
        if (has_features_) attributes["_FEATURE_ID_0"] = of_vertices(features_, sizeof(float), "SCALAR");
        const std::size_t indices = add_accessor(indices_, section.first_triangle * sizeof(glm::uvec3),
                                                 3 * section.triangles, kUnsigned, "SCALAR");
        Json primitive{
            {"attributes", std::move(attributes)}, {"indices", indices}, {"material", material_of(colour, system)}};
        if (has_features_) {
            const Json of_branches{{"featureCount", names_.vessels.size()}, {"attribute", 0}, {"label", "branch"}};
            primitive["extensions"][kFeatures] = {{"featureIds", Json::array({of_branches})}};
        }
        meshes_.push_back({{"name", name}, {"primitives", Json::array({std::move(primitive)})}});
        return meshes_.size() - 1;
    }

    [[nodiscard]] Bounds<glm::vec3> bounds_of(const MeshSections::Section& section) const {
        if (packed_ == nullptr) return {section.least, section.most};
        Bounds<glm::vec3> box;
        for (std::size_t n = 0; n < section.vertices; ++n) box.hold(packed_->seen[section.first_vertex + n]);
        return box;
    }

    [[nodiscard]] Json extras_of(std::size_t id) const {
        const MeshNames::Vessel& vessel = names_.vessels[id];
        Json extras{{"branch", id}, {"parent", vessel.parent >= 0 ? Json(vessel.parent) : Json()}};
        const auto children = children_.find(static_cast<int>(id));
        extras["children"] = children != children_.end() ? Json(children->second) : Json::array();
        extras["radius"] = vessel.radius_mm;
        extras["length"] = vessel.length_mm;
        extras["generation"] = vessel.generation;
        extras["strahler"] = vessel.strahler;
        if (!names_.systems.empty())
            extras["system"] = names_.systems[static_cast<std::size_t>(names_.branches[id].system)].name;
        return extras;
    }

    // One for each colour of a system.
    std::size_t material_of(const Colour& colour, std::optional<std::size_t> system) {
        const auto [at, fresh] = material_numbers_.try_emplace({system, colour}, materials_.size());
        if (fresh)
            materials_.push_back({{"name", system ? names_.systems[*system].name : "vessels"},
                                  {"pbrMetallicRoughness",
                                   {{"baseColorFactor", {linear(colour[0]), linear(colour[1]), linear(colour[2]), 1.0}},
                                    {"metallicFactor", 0.0},
                                    {"roughnessFactor", 0.5}}}});
        return at->second;
    }

    std::size_t add_node(std::size_t parent, Json node) {
        nodes_.push_back(std::move(node));
        nodes_[parent]["children"].push_back(nodes_.size() - 1);
        return nodes_.size() - 1;
    }

    std::size_t node_of_system(std::size_t system) {
        const auto [at, fresh] = system_nodes_.try_emplace(system, 0);
        if (fresh) at->second = add_node(0, {{"name", names_.systems[system].name}});
        return at->second;
    }

    const MeshNames& names_;
    const MeshSections& cut_;
    const PackedArrays* packed_;
    bool has_normals_, has_radii_, has_features_;
    std::map<int, std::vector<std::size_t>> children_; // by branch id
    Json json_;                                        // the rest: lists
    Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(), accessors_ = Json::array(),
         views_ = Json::array();
    int positions_ = 0, normals_ = 0, radii_ = 0, features_ = 0, indices_ = 0; // views
    std::map<std::pair<std::optional<std::size_t>, Colour>, std::size_t> material_numbers_;
    std::map<std::size_t, std::size_t> system_nodes_;
    std::size_t normal_bytes_ = 0; // of each
    std::uint64_t bytes_ = 0, packed_bytes_ = 0;
};

// The requested parts may be missing: the surface of a mask has no branches, many trees have no systems.
PartsBy possible(const mesh::TriangleMesh& mesh, const MeshNames& names) {
    if (!names_all(names, mesh.branches)) return PartsBy::kNone;
    return names.by == PartsBy::kSystem && names.systems.empty() ? PartsBy::kNone : names.by;
}

MeshSections cut_into_parts(const mesh::TriangleMesh& mesh, const MeshNames& names) {
    const auto branch = [&](const glm::uvec3& triangle) {
        return static_cast<std::size_t>(branch_of(triangle, mesh.branches));
    };
    switch (names.by) {
    case PartsBy::kSystem:
        return sections_of(mesh, names.systems.size(), [&](const glm::uvec3& triangle) {
            return static_cast<std::size_t>(names.branches[branch(triangle)].system);
        });
    case PartsBy::kBranch:
        return sections_of(mesh, names.branches.size(), branch);
    case PartsBy::kNone:
        break;
    }
    return sections_of(mesh, 1, [](const glm::uvec3&) { return std::size_t{0}; });
}

// Calls `use` with the branch of each vertex, as numbers that attributes can have. A part has its own: vertices on its
// border are in two.
template <class Use>
void for_features(const mesh::TriangleMesh& mesh, const MeshNames& names, const MeshSections& cut, const Use& use) {
    for (std::size_t part = 0; part < cut.sections.size(); ++part) {
        const MeshSections::Section& section = cut.sections[part];
        for (std::size_t n = 0; n < section.vertices; ++n) {
            const std::uint32_t vertex = cut.vertices[section.first_vertex + n];
            const auto branch = names.by == PartsBy::kBranch ? static_cast<std::int64_t>(part) : mesh.branches[vertex];
            use(static_cast<float>(branch));
        }
    }
}

template <class T> std::vector<T> gathered(const LargeArray<T>& values, const MeshSections& cut) {
    std::vector<T> all;
    all.reserve(values.empty() ? 0 : cut.vertices.size());
    if (!values.empty())
        for (const std::uint32_t v : cut.vertices) all.push_back(values[v]);
    return all;
}

PackedArrays packed_arrays(const mesh::TriangleMesh& mesh, const MeshNames& names, const MeshSections& cut) {
    PackedArrays packed;
    packed.positions = packed_positions(gathered(mesh.positions, cut), packed.seen);
    if (!mesh.normals.empty()) packed.normals = packed_normals(gathered(mesh.normals, cut));
    if (!mesh.radii.empty()) packed.radii = packed_numbers(gathered(mesh.radii, cut));
    if (of_vessels(mesh, names)) {
        std::vector<float> features;
        for_features(mesh, names, cut, [&](float branch) { features.push_back(branch); });
        packed.features = packed_whole_numbers(features);
    }
    packed.triangles = packed_triangles({cut.triangles.data(), cut.triangles.size()}, cut.vertices.size());
    return packed;
}

void write_plain(const mesh::TriangleMesh& mesh, const MeshNames& names, const MeshSections& cut, BufferedFile& file) {
    for (const std::uint32_t v : cut.vertices) file.write_value(mesh.positions[v]);
    if (!mesh.normals.empty())
        for (const std::uint32_t v : cut.vertices) file.write_value(mesh.normals[v]);
    if (!mesh.radii.empty())
        for (const std::uint32_t v : cut.vertices) file.write_value(mesh.radii[v]);
    if (of_vessels(mesh, names)) for_features(mesh, names, cut, [&](float branch) { file.write_value(branch); });
    file.write(cut.triangles.data(), cut.triangles.size() * sizeof(glm::uvec3));
}

void write_packed(const PackedArrays& packed, BufferedFile& file) {
    for (const GlbArray* array : packed.all()) {
        file.write(array->bytes);
        file.write(std::string(padded(array->bytes.size()) - array->bytes.size(), '\0'));
    }
}

} // namespace

Result<void> write_glb(const mesh::TriangleMesh& mesh, const MeshNames& names, const std::string& where,
                       BufferedFile& file) {
    MeshNames wanted = names;
    wanted.by = possible(mesh, names);
    const MeshSections cut = cut_into_parts(mesh, wanted);
    std::optional<PackedArrays> packed;
    if (wanted.compressed) packed = packed_arrays(mesh, wanted, cut);
    Scene scene(mesh, wanted, cut, packed ? &*packed : nullptr);
    for (std::size_t part = 0; part < cut.sections.size(); ++part) scene.add_part(part);
    const std::uint64_t binary = scene.bytes();
    const std::string text = std::move(scene).text();
    const std::uint64_t total = 12 + 8 + text.size() + 8 + binary;
    if (total > std::numeric_limits<std::uint32_t>::max())
        return fail("the surface is larger than the 4 GiB that a .glb file can have", where,
                    "use a lower --detail, or .ply");
    for (const std::uint64_t number :
         {std::uint64_t{kMagic}, std::uint64_t{2}, total, std::uint64_t{text.size()}, std::uint64_t{kJsonChunk}})
        file.write_value(static_cast<std::uint32_t>(number));
    file.write(text);
    file.write_value(static_cast<std::uint32_t>(binary));
    file.write_value(kBinaryChunk);
    if (packed)
        write_packed(*packed, file);
    else
        write_plain(mesh, wanted, cut, file);
    return {};
}

} // namespace ramus::io
