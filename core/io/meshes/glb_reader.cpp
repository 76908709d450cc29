#include "core/io/binary_numbers.h"
#include "core/io/json_text.h"
#include "core/io/meshes/glb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace ramus::io {

namespace {

using nlohmann::json;

constexpr std::string_view kGlbMark = "glTF";
constexpr std::size_t kMostGlbText = std::size_t{64} << 20; // of JSON, which takes many times its size in memory

// Why a file is refused, thrown inside of this file alone.
struct GlbRefusal {
    std::string what, hint;
};
constexpr const char* kExportAgain = "export it again";

[[noreturn]] void damaged_glb() { throw GlbRefusal{"this is no .glb mesh, or it is damaged", kExportAgain}; }

const json* member_of(const json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

std::size_t glb_index(const json* value, std::size_t without) {
    if (value == nullptr) return without;
    if (!value->is_number_unsigned()) damaged_glb();
    return value->get<std::size_t>();
}

std::string_view glb_text(const json* value) {
    return value != nullptr && value->is_string() ? std::string_view(value->get_ref<const std::string&>())
                                                  : std::string_view();
}

// So many numbers; none: there is no such list.
template <std::size_t count> std::optional<std::array<double, count>> glb_numbers(const json* list) {
    if (list == nullptr) return {};
    std::array<double, count> numbers{};
    if (!list->is_array() || list->size() != count) damaged_glb();
    for (std::size_t i = 0; i < count; ++i) {
        if (!(*list)[i].is_number()) damaged_glb();
        numbers[i] = (*list)[i].get<double>();
    }
    return numbers;
}

// From the axes of a node to those of its parent.
glm::dmat4 matrix_of(const json& node) {
    if (const auto given = glb_numbers<16>(member_of(node, "matrix"))) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = (*given)[static_cast<std::size_t>(i)];
        return matrix;
    }
    const auto move = glb_numbers<3>(member_of(node, "translation")).value_or(std::array{0.0, 0.0, 0.0});
    const auto turn = glb_numbers<4>(member_of(node, "rotation")).value_or(std::array{0.0, 0.0, 0.0, 1.0});
    const auto size = glb_numbers<3>(member_of(node, "scale")).value_or(std::array{1.0, 1.0, 1.0});
    return glm::translate(glm::dmat4(1.0), {move[0], move[1], move[2]}) *
           glm::mat4_cast(glm::dquat(turn[3], turn[0], turn[1], turn[2])) *
           glm::scale(glm::dmat4(1.0), {size[0], size[1], size[2]});
}

// From a node's axes to mm, RAS. What rounding alone keeps from being whole is whole, so that positions that were not
// moved come back to the bit.
glm::dmat4 to_ras(const glm::dmat4& to_scene) {
    constexpr double kRounding = 1e-12;
    glm::dmat4 back(0.0);
    back[0][0] = -1000.0, back[2][1] = 1000.0, back[1][2] = 1000.0, back[3][3] = 1.0;
    glm::dmat4 matrix = back * to_scene;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (const double whole = std::round(matrix[column][row]); std::abs(matrix[column][row] - whole) < kRounding)
                matrix[column][row] = whole;
    return matrix;
}

class GlbReader {
public:
    GlbReader(const json& description, std::string_view binary, std::size_t file_size)
        : description_(description), binary_(binary), most_corners_(file_size / 2) {}

    PolygonSoup read() {
        refuse_compression();
        struct Placed {
            std::size_t node;
            glm::dmat4 to_parent_scene;
        };
        std::vector<Placed> open;
        const std::size_t count = list_size("nodes");
        for (const std::size_t node : roots(count)) open.push_back({node, glm::dmat4(1.0)});
        std::vector<bool> seen(count, false); // each node has one parent
        while (!open.empty()) {
            const auto [number, above] = open.back();
            open.pop_back();
            const json& node = element("nodes", number);
            if (seen[number]) continue;
            seen[number] = true;
            const glm::dmat4 to_scene = above * matrix_of(node);
            if (const json* mesh = member_of(node, "mesh")) add_mesh(element("meshes", glb_index(mesh, 0)), to_scene);
            if (const json* children = member_of(node, "children"))
                for (const json& child : *children) open.push_back({glb_index(&child, 0), to_scene});
        }
        soup_.orientation = stated_axes();
        return std::move(soup_);
    }

private:
    [[nodiscard]] std::size_t list_size(const char* name) const {
        const json* list = member_of(description_, name);
        return list != nullptr && list->is_array() ? list->size() : 0;
    }
    [[nodiscard]] const json& element(const char* name, std::size_t number) const {
        if (number >= list_size(name)) damaged_glb();
        return description_[name][number];
    }

    void refuse_compression() const {
        const json* needed = member_of(description_, "extensionsRequired");
        if (needed == nullptr) return;
        for (const json& extension : *needed)
            for (const std::string_view compression : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
                if (glb_text(&extension) == compression)
                    throw GlbRefusal{"its triangles are compressed by " + std::string(compression),
                                     "export it without compression"};
    }

    // Of the scene that is shown; of a file without one all nodes.
    [[nodiscard]] std::vector<std::size_t> roots(std::size_t count) const {
        std::vector<std::size_t> roots;
        if (list_size("scenes") > 0) {
            const json& scene = element("scenes", glb_index(member_of(description_, "scene"), 0));
            if (const json* nodes = member_of(scene, "nodes"))
                for (const json& node : *nodes) roots.push_back(glb_index(&node, 0));
            return roots;
        }
        std::vector<bool> is_child(count, false);
        for (std::size_t n = 0; n < count; ++n)
            if (const json* children = member_of(element("nodes", n), "children"))
                for (const json& child : *children)
                    if (const std::size_t number = glb_index(&child, 0); number < count) is_child[number] = true;
        for (std::size_t n = 0; n < count; ++n)
            if (!is_child[n]) roots.push_back(n);
        return roots;
    }

    // What this program writes, it writes of a tree's axes.
    [[nodiscard]] std::optional<Orientation> stated_axes() const {
        const json* asset = member_of(description_, "asset");
        if (asset == nullptr || !glb_text(member_of(*asset, "generator")).starts_with("ramus")) return {};
        const auto top = roots(list_size("nodes"));
        const json* extras = top.empty() ? nullptr : member_of(element("nodes", top.front()), "extras");
        if (extras == nullptr || !Orientation::named(glb_text(member_of(*extras, "orientation")))) return {};
        return Orientation::ras(); // the nodes lead there
    }

    // The numbers of an accessor, one tuple after the other.
    [[nodiscard]] std::vector<double> numbers_of(const json& accessor, std::size_t parts) const {
        constexpr std::array<std::pair<std::size_t, NumberType>, 6> kTypes{{{5120, NumberType::kInt8},
                                                                            {5121, NumberType::kUInt8},
                                                                            {5122, NumberType::kInt16},
                                                                            {5123, NumberType::kUInt16},
                                                                            {5125, NumberType::kUInt32},
                                                                            {5126, NumberType::kFloat}}};
        const std::size_t code = glb_index(member_of(accessor, "componentType"), 0);
        const auto* const type = std::ranges::find(kTypes, code, &std::pair<std::size_t, NumberType>::first);
        if (type == kTypes.end() || glb_text(member_of(accessor, "type")) != (parts == 3 ? "VEC3" : "SCALAR") ||
            member_of(accessor, "sparse") != nullptr)
            damaged_glb();
        const json& view =
            element("bufferViews", glb_index(member_of(accessor, "bufferView"), list_size("bufferViews")));
        const std::size_t buffer = glb_index(member_of(view, "buffer"), 0);
        if (buffer != 0 || member_of(element("buffers", buffer), "uri") != nullptr)
            throw GlbRefusal{"its triangles are in another file", "export it as one .glb file"};
        const std::size_t size = size_of(type->second) * parts, count = glb_index(member_of(accessor, "count"), 0),
                          stride = glb_index(member_of(view, "byteStride"), size),
                          first = glb_index(member_of(view, "byteOffset"), 0),
                          offset = glb_index(member_of(accessor, "byteOffset"), 0);
        if (count == 0) return {};
        // Each is checked before it is reckoned with.
        const std::size_t most = binary_.size();
        if (first > most || offset > most - first || stride > most || stride < size || size > most - first - offset ||
            (count - 1) > (most - first - offset - size) / stride || count > most_corners_)
            damaged_glb();
        std::string packed;
        packed.reserve(count * size);
        for (std::size_t i = 0; i < count; ++i) packed += binary_.substr(first + offset + i * stride, size);
        std::vector<double> numbers = numbers_in(packed, type->second, std::endian::little);
        if (const json* normalized = member_of(accessor, "normalized"); normalized != nullptr && *normalized == true)
            normalize(numbers, type->second);
        return numbers;
    }

    // Whole numbers that stand for fractions: as KHR_mesh_quantization has them.
    static void normalize(std::vector<double>& numbers, NumberType type) {
        const double most = type == NumberType::kInt8    ? 127.0
                            : type == NumberType::kUInt8 ? 255.0
                            : type == NumberType::kInt16 ? 32767.0
                                                         : 65535.0;
        for (double& number : numbers) number = std::max(number / most, -1.0);
    }

    void add_mesh(const json& mesh, const glm::dmat4& to_scene) {
        const glm::dmat4 place = to_ras(to_scene);
        if (const json* primitives = member_of(mesh, "primitives"))
            for (const json& primitive : *primitives) add_primitive(primitive, place);
    }

    void add_primitive(const json& primitive, const glm::dmat4& place) {
        constexpr std::size_t kTriangles = 4, kFan = 6; // 5: a strip
        const std::size_t mode = glb_index(member_of(primitive, "mode"), kTriangles);
        const json* attributes = member_of(primitive, "attributes");
        const json* positions = attributes == nullptr ? nullptr : member_of(*attributes, "POSITION");
        if (mode < kTriangles || positions == nullptr) return; // points and lines
        if (mode > kFan) damaged_glb();
        const std::vector<double> numbers = numbers_of(element("accessors", glb_index(positions, 0)), 3);
        const std::size_t first = soup_.positions.size(), count = numbers.size() / 3;
        std::vector<double> corners;
        if (const json* indices = member_of(primitive, "indices"))
            corners = numbers_of(element("accessors", glb_index(indices, 0)), 1);
        else
            for (std::size_t v = 0; v < count; ++v) corners.push_back(static_cast<double>(v));
        // A mesh that many nodes show must not grow beyond the file's own size.
        if (corners.size() > most_corners_ - corners_ || count > most_corners_ - first)
            throw GlbRefusal{"its nodes repeat its meshes too often", "export it as one mesh"};
        corners_ += corners.size();
        for (std::size_t v = 0; v < count; ++v)
            soup_.positions.emplace_back(place *
                                         glm::dvec4(numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2], 1.0));
        std::vector<std::uint32_t> at;
        for (const double corner : corners) {
            if (!(corner >= 0.0 && corner < static_cast<double>(count))) damaged_glb();
            at.push_back(static_cast<std::uint32_t>(first + static_cast<std::size_t>(corner)));
        }
        const bool mirrored = glm::determinant(glm::dmat3(place)) < 0.0;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            soup_.polygons.push_back(mirrored ? std::vector{a, c, b} : std::vector{a, b, c});
        };
        for (std::size_t i = 2; i < at.size(); i += mode == kTriangles ? 3 : 1)
            if (mode == kTriangles)
                add(at[i - 2], at[i - 1], at[i]);
            else if (mode == kFan)
                add(at[0], at[i - 1], at[i]);
            else
                add(at[i - 2 + i % 2], at[i - 1 - i % 2], at[i]);
    }

    const json& description_;
    std::string_view binary_;
    std::size_t most_corners_, corners_ = 0;
    PolygonSoup soup_;
};

struct GlbChunks {
    std::string_view description, binary;
};

GlbChunks chunks_of(std::string_view text) {
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    const auto number = [&](std::size_t at) { return number_at<std::uint32_t>(text.data() + at, std::endian::little); };
    if (text.size() < kHeader + kChunkHeader || !is_glb(text)) damaged_glb();
    if (number(4) != 2)
        throw GlbRefusal{"this is glTF of version " + std::to_string(number(4)), "export it as glTF 2.0"};
    GlbChunks chunks;
    for (std::size_t at = kHeader; at + kChunkHeader <= text.size();) {
        const std::size_t length = number(at), type = number(at + 4);
        at += kChunkHeader;
        if (length > text.size() - at) damaged_glb();
        if (type == 0x4E4F534A && chunks.description.empty()) chunks.description = text.substr(at, length);
        if (type == 0x004E4942 && chunks.binary.empty()) chunks.binary = text.substr(at, length);
        at += length;
    }
    if (chunks.description.empty()) damaged_glb();
    if (chunks.description.size() > kMostGlbText)
        throw GlbRefusal{"its description has more than 64 MiB", "export it as one mesh, or as .ply"};
    return chunks;
}

} // namespace

bool is_glb(std::string_view head) { return head.starts_with(kGlbMark); }

Result<PolygonSoup> parse_glb(std::string_view text, const std::string& name) {
    try {
        const GlbChunks chunks = chunks_of(text);
        RAMUS_TRY(description, parsed_json(chunks.description, name));
        PolygonSoup soup = GlbReader(description, chunks.binary, text.size()).read();
        if (soup.polygons.empty()) throw GlbRefusal{"there are no triangles in it", "export a surface"};
        return soup;
    } catch (const GlbRefusal& refusal) {
        return fail(refusal.what, name, refusal.hint);
    }
}

} // namespace ramus::io
