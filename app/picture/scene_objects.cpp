#include "app/picture/scene_objects.h"

#include "app/assets/assets.h"
#include "app/assets/lesion_text.h"
#include "app/assets/territories.h"
#include "app/picture/colouring.h"
#include "app/picture/place_marks.h"
#include "app/picture/slices.h"
#include "core/base/lines.h"
#include "core/base/words.h"
#include "core/slice/pixel_grid.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <type_traits>

namespace ramus::app {

namespace {

constexpr double kMarkReach = 7.0; // points by which the pointer may miss a pin or a line

// A hidden sphere stays in the frame, since margins are measured from it; its opacity is 0.
void draw_object(const SceneDrawing& drawing, const Lesion& lesion) {
    if (drawing.assets.plan == nullptr) return;
    render::Lesions& lesions = drawing.frame.lesions;
    const auto mesh = lesion.visible ? drawing.assets.lesion_mesh(lesion) : nullptr;
    if (lesion.is_mesh() && !mesh) return;
    if (mesh)
        lesions.meshes.emplace_back(mesh, &mesh->mesh);
    else
        lesions.spheres.emplace_back(lesion.sphere[0], lesion.sphere[1], lesion.sphere[2], lesion.sphere[3]);
    lesions.looks.push_back({srgb_of(lesion.colour), lesion.visible ? static_cast<float>(lesion.opacity) : 0.0F});
}

void draw_object(const SceneDrawing& drawing, const ContextItem& item) {
    const auto shape = drawing.assets.context_shape(source_of(item));
    if (!shape) return;
    drawing.frame.context.push_back(
        {shape->mesh, shape->preview, srgb_of(item.colour), static_cast<float>(item.opacity), item.wireframe});
}

// Draws lines, end marks and the label; nothing if the measurement failed.
void draw_object(const SceneDrawing& drawing, const Measurement& measurement) {
    const auto* found = drawing.assets.measured(measurement.id);
    if (found == nullptr || !*found || measurement.id == drawing.viewing.measurement) return;
    render::Frame& frame = drawing.frame;
    // The distance from an axis to the wall in front of it is rarely larger.
    constexpr double kRadii = 2.0;
    const Measured& measured = **found;
    const glm::vec3 colour = srgb_of(measurement.colour);
    for (const auto& line : measured.lines)
        frame.lines.push_back({.points = line, .colour = colour, .inside_mm = kRadii * measured.inside_mm});
    for (const glm::dvec3& end : measured.ends) {
        frame.lines.push_back(dot_at(frame, end, colour));
        frame.lines.back().inside_mm = kRadii * measured.inside_mm;
    }
    frame.labels.push_back({measured.label_place, measured.label});
}

// Draws a ring around the place and the first words of the text.
void draw_object(const SceneDrawing& drawing, const Pin& pin) {
    const glm::vec3 colour = srgb_of(pin.colour);
    drawing.frame.lines.push_back(ring_facing_eye(drawing.frame, pin.at, 0.0, colour, false));
    drawing.frame.lines.push_back(dot_at(drawing.frame, pin.at, colour));
    if (!pin.name.empty()) drawing.frame.labels.push_back({pin.at, latin1(shortened(pin.name))});
}

// In the colours of the margins around lesions; its own is that beyond them.
void draw_object(const SceneDrawing& drawing, const Resection& resection) {
    const Operation::Parts* parts = surface_of(drawing.assets, resection);
    for (std::size_t n = 0; parts != nullptr && n < parts->size(); ++n) {
        const glm::vec3 colour =
            n + 1 < parts->size() ? margin_colour(n, parts->size() - 1) : srgb_of(resection.colour);
        if (!(*parts)[n]->triangles.empty())
            drawing.frame.context.push_back(
                {(*parts)[n], nullptr, colour, static_cast<float>(resection.opacity), false});
    }
}

// Slices draw it (app/picture/slices.h).
void draw_object(const SceneDrawing& /*drawing*/, const Scan& /*scan*/) {}

std::optional<glm::dvec3> under(const PointerInPicture& pointer, const std::vector<glm::dvec3>& line) {
    const double reach = kMarkReach * static_cast<double>(pointer.pixel_ratio);
    double nearest = reach;
    std::optional<glm::dvec3> found;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : 0;
        const auto from = render::project(pointer.camera, pointer.size, line[before]);
        const auto to = render::project(pointer.camera, pointer.size, line[i]);
        if (!from || !to) continue;
        const glm::dvec2 a(*from), along = glm::dvec2(*to) - a;
        const double share = share_along(pointer.pixel - a, along);
        const double away = glm::distance(pointer.pixel, a + share * along);
        if (away > nearest) continue;
        nearest = away;
        found = glm::mix(line[before], line[i], share);
    }
    return found;
}

std::optional<glm::dvec3> under(const PointerInPicture& pointer, const Assets& assets, const Marks& marks,
                                const Lesion& lesion) {
    if (pointer.pick.lesion == render::kNoLesion ||
        lesion_shapes(assets, marks).picked(pointer.pick.lesion) != lesion.id)
        return {};
    return pointer.pick.position;
}

std::optional<glm::dvec3> under(const PointerInPicture& /*pointer*/, const Assets& /*assets*/, const Marks& /*marks*/,
                                const ContextItem& /*item*/) {
    return {};
}

std::optional<glm::dvec3> under(const PointerInPicture& pointer, const Assets& assets, const Marks& /*marks*/,
                                const Measurement& measurement) {
    const auto* found = assets.measured(measurement.id);
    if (found == nullptr || !*found) return {};
    for (const auto& line : (*found)->lines)
        if (const auto at = under(pointer, line)) return at;
    return {};
}

std::optional<glm::dvec3> under(const PointerInPicture& pointer, const Assets& /*assets*/, const Marks& /*marks*/,
                                const Pin& pin) {
    return under(pointer, {pin.at});
}

std::optional<glm::dvec3> under(const PointerInPicture& /*pointer*/, const Assets& /*assets*/, const Marks& /*marks*/,
                                const Resection& /*resection*/) {
    return {};
}

std::optional<glm::dvec3> under(const PointerInPicture& /*pointer*/, const Assets& /*assets*/, const Marks& /*marks*/,
                                const Scan& /*scan*/) {
    return {};
}

std::string numbered(std::string_view what, std::size_t index) {
    return std::string(what) + " " + std::to_string(index + 1);
}
std::string file_name(const std::string& file) { return std::filesystem::path(file).filename().string(); }

// The file's name of the label, if known.
std::string label_words(const volume::LabelChoice& label, const ContextShape* shape) {
    if (label.none()) return {};
    if (shape != nullptr && shape->label && !shape->label->name.empty()) return "  " + shape->label->name;
    return label.name.empty() ? "  label " + std::to_string(label.number) : "  " + label.name;
}

} // namespace

void draw_objects(const SceneDrawing& drawing, const Marks& marks) {
    const SceneObjects& objects = drawing.viewing.objects ? *drawing.viewing.objects : marks;
    for_each_object(objects, [&](const SceneObject auto& object) {
        if (object.visible || std::is_same_v<std::remove_cvref_t<decltype(object)>, Lesion>)
            draw_object(drawing, object);
    });
}

void add_points(std::vector<glm::vec3>& points, const Assets& assets, const Lesion& lesion) {
    if (lesion.is_mesh()) {
        if (const auto mesh = assets.lesion_mesh(lesion))
            points.insert(points.end(), mesh->mesh.positions.begin(), mesh->mesh.positions.end());
        return;
    }
    // The corners of the inscribed and the circumscribed cube: round enough for fitting a camera.
    const glm::dvec3 centre(lesion.sphere[0], lesion.sphere[1], lesion.sphere[2]);
    for (int k = 0; k < 27; ++k) {
        const glm::dvec3 way(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        points.emplace_back(centre + lesion.sphere[3] / std::max(glm::length(way), 1.0) * way);
    }
}

void add_points(std::vector<glm::vec3>& points, const Assets& assets, const ContextItem& item) {
    if (const auto shape = assets.context_shape(source_of(item)))
        points.insert(points.end(), shape->mesh->positions.begin(), shape->mesh->positions.end());
}

void add_points(std::vector<glm::vec3>& points, const Assets& assets, const Measurement& measurement) {
    const auto* found = assets.measured(measurement.id);
    if (found == nullptr || !*found) return;
    for (const auto& line : (*found)->lines) points.insert(points.end(), line.begin(), line.end());
}

void add_points(std::vector<glm::vec3>& points, const Assets& /*assets*/, const Pin& pin) {
    points.emplace_back(pin.at);
}

void add_points(std::vector<glm::vec3>& points, const Assets& assets, const Resection& resection) {
    if (const Operation::Parts* parts = surface_of(assets, resection))
        for (const auto& part : *parts) points.insert(points.end(), part->positions.begin(), part->positions.end());
}

// The vessels fill the picture, whatever the scan covers: see visible_points().
void add_points(std::vector<glm::vec3>& /*points*/, const Assets& /*assets*/, const Scan& /*scan*/) {}

namespace {

// The corners of the scans.
void add_corners(std::vector<glm::vec3>& points, const Assets& assets, const Marks& marks) {
    for (const Scan& scan : marks.scans) {
        const auto file = scan.visible ? assets.scan(scan) : nullptr;
        if (!file) continue;
        const Bounds<glm::dvec3> box = slice::bounds_of(*file->volume);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 high((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
            points.emplace_back(glm::mix(box.least, box.most, high));
        }
    }
}

} // namespace

std::vector<glm::vec3> visible_points(const Marks& marks, const Assets& assets) {
    std::vector<glm::vec3> points;
    for_each_object(marks, [&]<class T>(const T& object) {
        if constexpr (SurfaceObject<T>)
            if (object.opacity == 0.0) return;
        if (object.visible) add_points(points, assets, object);
    });
    if (assets.organ.territories && marks.organ.territories != TerritoriesOf::kNothing && marks.organ.opacity > 0.0)
        for (const OrganTerritories::Part& part : assets.organ.territories->parts)
            points.insert(points.end(), part.mesh->positions.begin(), part.mesh->positions.end());
    if (points.empty() && !assets.tree) add_corners(points, assets, marks);
    return points;
}

std::optional<ObjectPlace> object_under(const PointerInPicture& pointer, const Assets& assets, const Marks& marks) {
    std::optional<ObjectPlace> found;
    for_each_object_list(marks, [&]<class T>(const std::vector<T>& list) {
        for (std::size_t i = 0; i < list.size(); ++i)
            if (const auto at = list[i].visible ? under(pointer, assets, marks, list[i]) : std::nullopt)
                found = {T::kNoun, i, *at};
    });
    return found;
}

ObjectWords words_of(const Lesion& lesion, std::size_t index, const Assets& assets, const Lengths& lengths) {
    if (!lesion.is_mesh())
        return {lesion.name.empty() ? numbered("Lesion", index) : lesion.name,
                "\xC3\x98 " + lengths.text(2.0 * lesion.sphere[3])};
    ObjectWords words{lesion.name};
    if (words.title.empty()) words.title = lesion.of_mask() ? numbered("Lesion", index) : file_name(lesion.file);
    words.details = lesion.file;
    if (const auto trouble = assets.trouble(lesion)) words.trouble = true, words.details = trouble->message();
    if (const auto mesh = assets.lesion_mesh(lesion)) {
        words.value = size_text(*mesh, lengths);
        words.details += std::string("\n\xC3\x98: ") + kLargestDiameter;
    }
    return words;
}

ObjectWords words_of(const ContextItem& item, std::size_t /*index*/, const Assets& assets, const Lengths& /*lengths*/) {
    const auto shape = assets.context_shape(source_of(item));
    const auto trouble = assets.trouble(source_of(item));
    ObjectWords words{item.name.empty() ? file_name(item.file) + label_words(item.label, shape.get()) : item.name};
    if (item.isovalue) words.value = "from " + rounded(*item.isovalue);
    words.trouble = trouble.has_value();
    words.details = !trouble                       ? item.file + (shape ? "" : "\nBeing read")
                    : trouble->what == "cancelled" ? item.file + "\nNot read: cancelled"
                                                   : trouble->message();
    return words;
}

ObjectWords words_of(const Measurement& measurement, std::size_t index, const Assets& assets,
                     const Lengths& /*lengths*/) {
    const auto* found = assets.measured(measurement.id);
    ObjectWords words{measurement.name};
    if (found == nullptr) {
        if (words.title.empty()) words.title = numbered("Measurement", index);
        return words;
    }
    words.trouble = !*found;
    if (words.title.empty()) words.title = words.trouble ? "cannot be measured" : (*found)->kind;
    words.details = words.trouble ? found->error().message() : (*found)->what;
    if (words.trouble) return words;
    for (const auto& [name, value] : (*found)->details) words.details += "\n" + name + ": " + value;
    words.value = (*found)->value_text();
    return words;
}

ObjectWords words_of(const Resection& resection, std::size_t index, const Assets& assets, const Lengths& lengths) {
    using Kind = Resection::Kind;
    ObjectWords words{resection.name};
    const std::string margin = lengths.text(resection.margin_mm);
    switch (resection.kind) {
    case Kind::kPlane:
        words.details = "A plane";
        break;
    case Kind::kSheet:
        words.details = "A sheet with " + std::to_string(resection.sheet.heights.size()) + " control points";
        break;
    case Kind::kSurface:
        words.details = resection.file;
        if (const auto mesh = assets.organ.meshes.find(resection.file);
            mesh != assets.organ.meshes.end() && !mesh->second.surface)
            words.trouble = true, words.details = mesh->second.surface.error().message();
        break;
    case Kind::kCuts:
        words.details = "All that depends on the cuts, and " + margin + " around it";
        break;
    case Kind::kLesion:
        words.details = "A lesion, and " + margin + " around it";
        break;
    }
    constexpr std::array<std::string_view, 5> kTitles{"Plane", "Sheet", "Surface", "Beyond the cuts", "Around lesion"};
    if (words.title.empty()) words.title = numbered(kTitles[static_cast<std::size_t>(resection.kind)], index);
    const Operation::Parts* parts = surface_of(assets, resection);
    if (!words.trouble && parts != nullptr && parts->empty()) words.details += "\nIt does not meet the organ";
    return words;
}

ObjectWords words_of(const Scan& scan, std::size_t /*index*/, const Assets& assets, const Lengths& lengths) {
    ObjectWords words{scan.name.empty() ? file_name(scan.file) : scan.name};
    words.details = scan.file;
    if (const auto trouble = assets.trouble(scan)) {
        words.trouble = true;
        words.details = trouble->what == "cancelled" ? scan.file + "\nNot read: cancelled" : trouble->message();
        return words;
    }
    const auto file = assets.scan(scan);
    if (!file) {
        words.details += "\nBeing read";
        return words;
    }
    words.details += "\n" + words_of_scan(*file, lengths);
    if (!scan.labels) {
        const slice::Window window = window_of(scan, *file);
        words.value = rounded(window.width) + " / " + rounded(window.level);
    }
    return words;
}

ObjectWords words_of(const Pin& pin, std::size_t index, const Assets& /*assets*/, const Lengths& /*lengths*/) {
    return {pin.name.empty() ? numbered("Pin", index) : pin.name};
}

ObjectWords words_of(const ObjectPlace& place, const Marks& marks, const Assets& assets, const Lengths& lengths) {
    ObjectWords words;
    for_each_object_list(marks, [&]<class T>(const std::vector<T>& list) {
        if (place.kind == T::kNoun && place.index < list.size())
            words = words_of(list[place.index], place.index, assets, lengths);
    });
    return words;
}

} // namespace ramus::app
