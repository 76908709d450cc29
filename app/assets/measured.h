// What a kept measurement says: its value with a unit, in words, and what to draw for it. Derived from the tree:
// measurements hold only what was asked for (app/session/session.h).
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
    std::vector<std::pair<std::string, std::string>> details{}; // what belongs to it: ("cross-section", "12.6 mm2")
    std::vector<std::vector<glm::dvec3>> lines{};               // mm, RAS: what was measured, as polylines
    double inside_mm = 0.0;                                     // radius of the vessels that the lines run in
    std::vector<glm::dvec3> ends{};                             // mm, RAS: its points or places, in their order
    std::string label{};                                        // of the picture: "path 12.3 mm"
    glm::dvec3 label_place{0.0};                                // mm, RAS

    [[nodiscard]] std::string value_text() const; // "12.3 mm"
    [[nodiscard]] std::string sentence() const;   // "Distance, (1, 2, 3) to (1, 2, 9): 6.00 mm"
};

struct Assets; // app/assets/assets.h

// The session's lesions, in their order, as measurements are taken from them. Lesions are named by their ids.
struct LesionShapes {
    struct Shape {
        Lesion lesion;
        std::shared_ptr<const measure::MeshDistance> mesh; // null: a sphere, or not read
        bool operator==(const Shape&) const = default;
        [[nodiscard]] bool is_there() const { return !lesion.is_mesh() || mesh; }
    };
    std::vector<Shape> shapes;
    bool operator==(const LesionShapes&) const = default;
    [[nodiscard]] const Shape* find(int id) const; // null: there is no such lesion
    // None: there is no such lesion, or its mesh has not been read.
    [[nodiscard]] std::optional<measure::Lesion> at(int id) const;
    [[nodiscard]] std::string name_of(int id) const; // "lesion 2"
    // The id of what a pick shows: picks count the lesions that are drawn.
    [[nodiscard]] int picked(int lesion) const;
};
[[nodiscard]] LesionShapes lesion_shapes(const Assets& assets, const Marks& marks);

// distance: straight, between its points, or the shortest from a lesion's surface to a branch's wall (0 where they
// overlap); it fails where the lesion is not there, or where a point that lies on it does so no longer. path: the
// shortest way along centerlines between its places. diameter: at its place. angle: at the second of its places,
// between the straight lines to the others; of one place where the branch begins, between the way its parent comes and
// the branch, 0 being straight on; at a root between it and the first other branch there. Fails when there is no such
// branch, no such way, no branching or no angle.
[[nodiscard]] Result<Measured> measured(const tree::VesselTree& tree, const Measurement& measurement,
                                        const LesionShapes& lesions);

// What it is between, and what a tool can move: its points or, on the centerlines, its places; none where a branch
// begins, and of shortest distances. Branches that there are not have none.
[[nodiscard]] std::vector<glm::dvec3> ends_of(const tree::VesselTree& tree, const Measurement& measurement);

// A session's measurements and what they say, in their order, or why they say nothing.
struct Measurements {
    std::vector<Measurement> of;
    LesionShapes lesions;
    std::vector<Result<Measured>> found;
    std::unordered_map<int, std::size_t> places; // in `found`, by id
};

} // namespace ramus::app
