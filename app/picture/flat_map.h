// FlatMap: the cut surface of a plane or a sheet laid flat, as it is seen after the part is removed, with its distances
// from lesions, the vessels that are cut and the place of the least margin. For panels and reports.
#pragma once

#include "app/assets/operation.h"
#include "core/base/bounds.h"

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

// Places are projected along the normal of the plane, or of the sheet's base plane: areas are true for planes, and too
// small where a sheet is steep. mm, x to the right and y upward.
struct FlatMap {
    struct Band {             // by distance from the nearest lesion; one of all where there is none
        std::string distance; // "5 to 10"; empty: no lesion
        glm::vec3 colour{0.0F};
        std::vector<std::array<glm::vec2, 3>> triangles;
    };
    struct Vessel {
        glm::vec2 at{0.0F};
        float radius_mm = 0.0F;
        glm::vec3 colour{0.0F}; // of its system
        int branch = 0;
        double diameter_mm = 0.0;
    };
    struct Nearest {
        glm::vec2 at{0.0F};
        double margin_mm = 0.0;
        std::string lesion;
    };
    std::vector<Band> bands;
    std::vector<Vessel> vessels;  // the thickest first
    std::vector<Nearest> nearest; // by lesion, the places of its margin that are on this surface
    Bounds<glm::vec2> box;
    std::array<std::size_t, 4> sides{}; // left, right, lower and upper edge, as indices in render::AxisNames
};

// `resection`: its index in the plan. None: it is neither plane nor sheet, or does not meet the organ. `marks`: for the
// colours.
[[nodiscard]] std::optional<FlatMap> flat_map_of(const Operation& operation, std::size_t resection, const Marks& marks);

} // namespace ramus::app
