#include "app/picture/scene_objects.h"

#include "app/assets/assets.h"
#include "app/picture/colouring.h"
#include "app/picture/place_marks.h"
#include "core/base/words.h"

#include <algorithm>

namespace ramus::app {

namespace {

constexpr glm::vec3 kMeasureColour{0.55F, 0.93F, 0.82F};

// The item, or its trial version while a slider or colour is changed.
const ContextItem& as_tried(const Viewing& viewing, const ContextItem& item) {
    if (!viewing.context) return item;
    const auto tried = std::ranges::find(*viewing.context, item.id, &ContextItem::id);
    return tried == viewing.context->end() ? item : *tried;
}

void draw_object(const SceneDrawing& drawing, const Lesion& lesion) {
    if (drawing.assets.plan == nullptr) return;
    render::Lesions& lesions = drawing.frame.lesions;
    if (!lesion.is_mesh())
        lesions.spheres.emplace_back(lesion.sphere[0], lesion.sphere[1], lesion.sphere[2], lesion.sphere[3]);
    else if (const auto mesh = drawing.assets.lesion_mesh(lesion.file))
        lesions.meshes.emplace_back(mesh, &mesh->mesh);
}

void draw_object(const SceneDrawing& drawing, const ContextItem& item) {
    const ContextItem& shown = as_tried(drawing.viewing, item);
    const auto shape = drawing.assets.context_shape(source_of(shown));
    if (!shape) return;
    const glm::vec3 colour(shown.colour[0], shown.colour[1], shown.colour[2]);
    drawing.frame.context.push_back(
        {shape->mesh, shape->preview, colour / 255.0F, static_cast<float>(shown.opacity), shown.wireframe});
}

// Draws lines, end marks and the label; nothing if the measurement failed.
void draw_object(const SceneDrawing& drawing, const Measurement& measurement) {
    const auto* found = drawing.assets.measured(measurement.id);
    if (found == nullptr || !*found || measurement.id == drawing.viewing.measurement) return;
    render::Frame& frame = drawing.frame;
    // The distance from an axis to the wall in front of it is rarely larger.
    constexpr double kRadii = 2.0;
    const Measured& measured = **found;
    for (const auto& line : measured.lines)
        frame.lines.push_back({.points = line, .colour = kMeasureColour, .inside_mm = kRadii * measured.inside_mm});
    for (const glm::dvec3& end : measured.ends) {
        frame.lines.push_back(dot_at(frame, end, kMeasureColour));
        frame.lines.back().inside_mm = kRadii * measured.inside_mm;
    }
    frame.labels.push_back({measured.label_place, measured.label});
}

// Draws a ring around the place and the first words of the text.
void draw_object(const SceneDrawing& drawing, const Pin& pin) {
    constexpr glm::vec3 kPinColour{0.98F, 0.80F, 0.35F};
    drawing.frame.lines.push_back(ring_facing_eye(drawing.frame, pin.at, 0.0, kPinColour, false));
    drawing.frame.lines.push_back(dot_at(drawing.frame, pin.at, kPinColour));
    if (!pin.name.empty()) drawing.frame.labels.push_back({pin.at, latin1(shortened(pin.name))});
}

} // namespace

void draw_objects(const SceneDrawing& drawing, const Marks& marks) {
    for_each_object(marks, [&](const SceneObject auto& object) {
        if (object.visible) draw_object(drawing, object);
    });
}

} // namespace ramus::app
