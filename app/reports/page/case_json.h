// The JSON of a page: all of a case but its geometry. Lengths in mm, places in mm, RAS; what is claimed of both is in
// `claims`. assets/page/decode.js and the viewer read it. No path is in it.
#pragma once

#include "app/picture/ground.h"
#include "app/session/document.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

inline constexpr int kCaseFormat = 1;

// The surfaces that the JSON names by number.
struct PageMeshes {
    std::vector<std::shared_ptr<const mesh::TriangleMesh>> list;
    std::size_t add(std::shared_ptr<const mesh::TriangleMesh> mesh) {
        list.push_back(std::move(mesh));
        return list.size() - 1;
    }
};

struct CaseHead {
    std::string title, file, checksum, made; // may be empty
    Ground ground = Ground::kDark;
    bool tables = true;
};

// The document must have a tree, and the assets must be complete. Adds the surfaces of objects to `meshes`.
[[nodiscard]] nlohmann::ordered_json case_json(const Document& document, const Assets& assets, const CaseHead& head,
                                               PageMeshes& meshes);

// Parts of it. The objects of the scene: lesions, context, measurements, notes, pins, contacts.
void add_objects(nlohmann::ordered_json& json, const Document& document, const Assets& assets, PageMeshes& meshes);
// Plans with what they lose and their resections; territories.
void add_plans(nlohmann::ordered_json& json, const Document& document, const Assets& assets, PageMeshes& meshes);

[[nodiscard]] std::string page_colour(const glm::vec3& srgb); // "#c98268"
[[nodiscard]] double page_number(double value);               // rounded to seven digits
[[nodiscard]] nlohmann::ordered_json page_place(const glm::dvec3& place);

} // namespace ramus::app
