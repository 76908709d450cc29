// Measured: the result of a measurement: value with unit, description, and lines to draw. Derived from the tree; a
// Measurement (app/session/objects.h) has only the request.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/measure/lesion_contact.h"

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ramus::app {

struct Measured {
    std::string kind;   // "Distance", "Path", "Diameter", "Angle"
    std::string what{}; // "branch 3 at 40 % to branch 17 at 5 %"
    double value = 0.0;
    std::string unit;                                           // "mm", "units" or "\u00B0"
    std::vector<std::pair<std::string, std::string>> details{}; // further values: ("cross-section", "12.6 mm2")
    std::vector<std::vector<glm::dvec3>> lines{};               // mm, RAS: the measured lines, as polylines
    double inside_mm = 0.0;                                     // radius of the vessels around the lines
    std::vector<glm::dvec3> ends{};                             // mm, RAS: its points or places, in order
    std::string label{};                                        // in the picture: "path 12.3 mm"
    glm::dvec3 label_place{0.0};                                // mm, RAS

    [[nodiscard]] std::string value_text() const; // "12.3 mm"
    [[nodiscard]] std::string sentence() const;   // "Distance, (1, 2, 3) to (1, 2, 9): 6.00 mm"
};

struct Assets;  // app/assets/assets.h
class Document; // app/session/document.h

// The session's lesions in their order, as measurements use them; identified by id.
struct LesionShapes {
    struct Shape {
        Lesion lesion;
        std::shared_ptr<const measure::MeshDistance> mesh; // null: a sphere, or not read
        bool operator==(const Shape&) const = default;
        [[nodiscard]] bool is_there() const { return !lesion.is_mesh() || mesh; }
    };
    std::vector<Shape> shapes;
    bool operator==(const LesionShapes&) const = default;
    [[nodiscard]] const Shape* find(int id) const; // null: no such lesion
    // None: no such lesion, or its mesh is not read.
    [[nodiscard]] std::optional<measure::Lesion> at(int id) const;
    [[nodiscard]] std::string name_of(int id) const; // "lesion 2"
    // The id of a picked lesion; picks count the lesions of the frame: spheres, and meshes that are shown.
    [[nodiscard]] int picked(int lesion) const;
};
[[nodiscard]] LesionShapes lesion_shapes(const Assets& assets, const Marks& marks);

// The tree in which a document's measurements are taken: its own, or one without branches, in which only distances
// between places can be measured.
[[nodiscard]] std::shared_ptr<const tree::VesselTree> measured_tree(const Document& document);

// Takes a measurement:
// - distance: straight between its points, or the shortest from a lesion's surface to a branch's wall (0 if they
//   overlap). Fails if the lesion is not loaded, or if a point is no longer on its lesion.
// - path: the shortest path along centerlines between its places.
// - diameter: at its place.
// - angle: at the second of its places, between the straight lines to the others. With one place: at the start of the
//   branch, between the parent's direction and the branch's, where 0 is straight on; at a root, between the branch and
//   the first other branch there. Also fails without such a branch, path, branching or angle.
[[nodiscard]] Result<Measured> measured(const tree::VesselTree& tree, const Measurement& measurement,
                                        const LesionShapes& lesions);

// The ends that a tool can move: its points, or its places on centerlines. None for angles at the start of a branch,
// for shortest distances, and for missing branches.
[[nodiscard]] std::vector<glm::dvec3> ends_of(const tree::VesselTree& tree, const Measurement& measurement);

// A session's measurements and their results, or why they failed, in order.
struct Measurements {
    std::vector<Measurement> of;
    std::string unit;
    LesionShapes lesions;
    std::vector<Result<Measured>> found;
    std::unordered_map<int, std::size_t> places; // index into `found`, by id
};

} // namespace ramus::app
