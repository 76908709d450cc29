// What the program asks of an object of the scene (app/session/objects.h), whatever its kind: how it is drawn, where it
// is, whether it is under the pointer, and its words in panels. scene_objects.cpp has one function for each question
// and kind, so a missing one does not compile.
#pragma once

#include "app/picture/compose.h"
#include "app/session/numbers.h"
#include "app/session/session.h"
#include "render/renderer/drawn.h"
#include "render/scene/bounds.h"
#include "render/scene/frame.h"

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// Inputs of drawing an object, and the frame to add to; its camera, size and pixel ratio are set.
struct SceneDrawing {
    render::Frame& frame;
    const Assets& assets;
    const Viewing& viewing;
};

// Draws all visible objects; files that are not read yet are omitted. Lesions and measurements need a tree.
void draw_objects(const SceneDrawing& drawing, const Marks& marks);

// Appends points (mm) whose convex hull contains the object; none while its file is not read, or if it cannot be
// measured.
void add_points(std::vector<glm::vec3>& points, const Assets& assets, const Lesion& lesion);
void add_points(std::vector<glm::vec3>& points, const Assets& assets, const ContextItem& item);
void add_points(std::vector<glm::vec3>& points, const Assets& assets, const Measurement& measurement);
void add_points(std::vector<glm::vec3>& points, const Assets& assets, const Pin& pin);
void add_points(std::vector<glm::vec3>& points, const Assets& assets, const Resection& resection);
void add_points(std::vector<glm::vec3>& points, const Assets& assets, const Scan& scan);
// Of all visible objects. Without a tree and without other objects, of the scans.
[[nodiscard]] std::vector<glm::vec3> visible_points(const Marks& marks, const Assets& assets);

// A visible object under the pointer, and the place on it (mm).
struct ObjectPlace {
    std::string_view kind; // its kNoun
    std::size_t index = 0; // in its list
    glm::dvec3 at{0.0};
    bool operator==(const ObjectPlace&) const = default;
};
struct PointerInPicture {
    const render::Camera& camera;
    glm::ivec2 size;          // of the picture
    float pixel_ratio = 1.0F; // marks may be missed by a few points
    glm::dvec2 pixel{0.0};
    const render::Pick& pick; // what the picture shows there
};
// Pins and measurements are in front of lesions; context is never under the pointer, since vessels are picked through
// it.
[[nodiscard]] std::optional<ObjectPlace> object_under(const PointerInPicture& pointer, const Assets& assets,
                                                      const Marks& marks);

// The words of an object's row.
struct ObjectWords {
    std::string title;     // its name, or what it is: "Lesion 2"
    std::string value{};   // "12.3 mm"
    std::string details{}; // sentences, or lines
    bool trouble = false;  // it cannot be read or measured; `details` says why
};
[[nodiscard]] ObjectWords words_of(const Lesion& lesion, std::size_t index, const Assets& assets,
                                   const Lengths& lengths);
[[nodiscard]] ObjectWords words_of(const ContextItem& item, std::size_t index, const Assets& assets,
                                   const Lengths& lengths);
[[nodiscard]] ObjectWords words_of(const Measurement& measurement, std::size_t index, const Assets& assets,
                                   const Lengths& lengths);
[[nodiscard]] ObjectWords words_of(const Resection& resection, std::size_t index, const Assets& assets,
                                   const Lengths& lengths);
[[nodiscard]] ObjectWords words_of(const Scan& scan, std::size_t index, const Assets& assets, const Lengths& lengths);
[[nodiscard]] ObjectWords words_of(const Pin& pin, std::size_t index, const Assets& assets, const Lengths& lengths);
// Of the object at that place.
[[nodiscard]] ObjectWords words_of(const ObjectPlace& place, const Marks& marks, const Assets& assets,
                                   const Lengths& lengths);

} // namespace ramus::app
