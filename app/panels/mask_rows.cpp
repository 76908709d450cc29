// Rows of the import doctor for turning a mask into a tree; each change makes the tree anew.
#include "app/panels/choice_row.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/parts.h"
#include "app/panels/slider_row.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/mask_reading.h"
#include "app/session/numbers.h"
#include "core/measure/branch_point.h"
#include "core/volume/skeletonize/skeletonize.h"

#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

constexpr float kMostBulge = 4.0F, kMostIsland = 100.0F; // mm; commands take more

std::string hundredths(float value) { return rounded(std::round(100.0 * value) / 100.0); }

void draw_labels(InterfaceContext& context, const io::MaskReading& mask) {
    const std::string now = mask.labels ? spelled(*mask.labels) : "apart";
    std::vector<std::pair<std::string, std::string>> entries{{"apart", "Each a system of its own"},
                                                             {"together", "All together one tree"}};
    if (mask.labels && !mask.labels->empty()) entries.emplace_back(now, "Systems " + now);
    if (const auto chosen =
            widgets::choice_row("Labels", "Which labels of the mask become which systems", now, entries))
        context.perform("read-as", {"labels", *chosen});
}

void draw_sizes(InterfaceContext& context, const io::MaskReading& mask) {
    Doctor& doctor = context.interface.of<Doctor>();
    const volume::SkeletonizeOptions usual;
    const auto slider = [](float most) {
        return [most](float& value) {
            ImGui::SliderFloat("##slider", &value, 0.0F, most, "", ImGuiSliderFlags_AlwaysClamp);
        };
    };
    if (widgets::slider_row("Bulges", "What stands out of a wall farther than this times its thickness is a vessel",
                            doctor.bulge_size, static_cast<float>(mask.bulge_size.value_or(usual.bulge_size)),
                            slider(kMostBulge), [](float value) { return hundredths(value); }))
        context.perform("read-as", {"bulge-size", hundredths(doctor.bulge_size.value)});
    if (widgets::slider_row("Islands", "Pieces that are nowhere longer than this are left out", doctor.islands,
                            static_cast<float>(mask.islands_mm.value_or(usual.islands_mm)), slider(kMostIsland),
                            [](float value) { return digits(value, 2) + " mm"; }))
        context.perform("read-as", {"islands", digits(doctor.islands.value, 2)});
    bool fill = mask.fill_holes.value_or(usual.fill_holes);
    if (ImGui::Checkbox("Close loops", &fill)) context.perform("read-as", {"fill-holes", fill ? "on" : "auto"});
    widgets::tooltip("Vessels that touch, and holes in the mask, make loops; each is closed where it is thinnest");
}

// The free end of the selected branch, or its middle.
std::optional<glm::dvec3> selected_place(const Document& document) {
    const std::vector<int>& selection = document.marks().selection;
    if (selection.size() != 1) return {};
    const tree::Branch& branch = document.tree()->branches[static_cast<std::size_t>(selection.front())];
    if (branch.children.empty()) return document.tree()->points[branch.points.back()].position;
    if (branch.parent == tree::kNoBranch) return document.tree()->points[branch.points.front()].position;
    return measure::point_on(*document.tree(), selection.front(), 0.5).position;
}

std::string whole(double value) { return std::to_string(std::lround(value)); }

void draw_root(InterfaceContext& context, const io::MaskReading& mask) {
    constexpr const char *kSelected = "selected", *kPlace = "place";
    const Document& document = context.workspace.document();
    Doctor& doctor = context.interface.of<Doctor>();
    std::vector<std::pair<std::string, std::string>> entries{{"auto", "Thickest end of each piece"}};
    const auto selected = selected_place(document);
    if (selected) entries.emplace_back(kSelected, "End nearest to the selected branch");
    entries.emplace_back(kPlace, "End nearest to a place\xE2\x80\xA6");
    const std::string now = mask.root ? exact_place(*mask.root) : "auto";
    if (mask.root)
        entries.emplace_back(now, "At " + whole(mask.root->x) + ", " + whole(mask.root->y) + ", " +
                                      whole(mask.root->z) + " mm");
    if (const auto chosen = widgets::choice_row(
            "Root",
            "The end that all others depend on: where blood enters an artery or a portal vein, and leaves a vein", now,
            entries)) {
        doctor.place = *chosen == kPlace;
        if (*chosen == kSelected)
            context.perform("read-as", {"root", exact_place(*selected)});
        else if (!doctor.place)
            context.perform("read-as", {"root", *chosen});
    }
    if (!doctor.place) return;
    widgets::begin_row("Place", "X,Y,Z in mm, to the right, anterior and superior; Enter takes it");
    const bool entered = ImGui::InputTextWithHint("##place", "mm: X,Y,Z", doctor.root.data(), doctor.root.size(),
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PopID();
    if (!entered) return;
    context.perform("read-as", {"root", doctor.root.data()});
    doctor.place = false;
}

} // namespace

void draw_mask_reading(InterfaceContext& context, const io::MaskReading& mask) {
    const tree::VesselTree& tree = *context.workspace.document().tree();
    if (mask.isovalue) widgets::fact("Threshold", "at least " + rounded(*mask.isovalue));
    if (mask.labels || tree.systems.size() > 1) draw_labels(context, mask);
    draw_sizes(context, mask);
    draw_root(context, mask);
}

} // namespace ramus::app
