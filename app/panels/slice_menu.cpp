#include "app/panels/slice_menu.h"

#include "app/panels/theme.h"
#include "app/picture/slices.h"
#include "app/session/numbers.h"
#include "core/measure/branch_point.h"

#include <cctype>
#include <imgui.h>
#include <string_view>

namespace ramus::app {

namespace {

using Line = std::vector<std::string>; // a command and its arguments

class SliceEntries {
public:
    explicit SliceEntries(const SliceViews& views) : views_(views) {}

    void entry(const std::string& label, Line line, bool checked = false) {
        if (ImGui::MenuItem(label.c_str(), nullptr, checked)) chosen = std::move(line);
        widgets::note_item(("menu: " + label).c_str());
    }

    void windows(const Scan& scan) {
        const bool open = ImGui::BeginMenu("Window");
        widgets::note_item("menu: Window");
        if (!open) return;
        entry("Automatic", {"window", "auto"}, !scan.window);
        for (const slice::WindowPreset& preset : slice::kWindowPresets)
            entry("CT " + std::string(preset.name), {"window", std::string(preset.name)}, scan.window == preset.window);
        ImGui::EndMenu();
    }

    void slabs() {
        const bool open = ImGui::BeginMenu("Slab");
        widgets::note_item("menu: Slab");
        if (!open) return;
        const slice::Sampling& now = views_.sampling;
        entry("Off", {"slab", "off"}, now.slab_mm == 0.0);
        constexpr double kUsualSlabMm = 10.0;
        const double mm = now.slab_mm > 0.0 ? now.slab_mm : kUsualSlabMm;
        for (const auto& [slab, name] : slice::kSlabs) {
            std::string label(name);
            label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
            entry(label + " of " + digits(mm) + " mm", {"slab", exact_text(mm), std::string(name)},
                  now.slab_mm > 0.0 && now.slab == slab);
        }
        ImGui::EndMenu();
    }

    Line chosen;

private:
    const SliceViews& views_;
};

} // namespace

std::vector<std::string> draw_slice_entries(const InterfaceContext& context, const SliceSpot& spot, int branch) {
    const Document& document = context.workspace.document();
    const SliceViews& views = document.session().slices;
    const std::string name(slice::name_of(spot.direction));
    SliceEntries entries(views);
    const std::string place = place_words(spot.place, slice_claims(document.session(), context.workspace.assets()));
    ImGui::TextColored(theme::kAccent, "%s", place.c_str());
    ImGui::Separator();
    if (const Scan* scan = document.marks().grey_scan()) entries.windows(*scan);
    entries.slabs();
    ImGui::Separator();
    if (slices_of(views.layout).size() > 1)
        entries.entry("Make large", {"layout", name});
    else
        entries.entry("Back to vessels and slices", {"layout", "slices"});
    if (views.zooms[slice_index(spot.direction)] != SliceZoom{})
        entries.entry("Show all of the slice", {"slice-zoom", name, "fit"});
    const bool shown = views.in_picture[slice_index(spot.direction)];
    entries.entry("Show among the vessels", {"slice-plane", name, shown ? "off" : "on"}, shown);
    const bool cuts = views.cut_away == spot.direction;
    entries.entry("Cut away before it", {"cut-away", cuts ? "off" : name}, cuts);
    ImGui::Separator();
    if (const auto& tree = document.tree(); tree && branch != tree::kNoBranch)
        entries.entry("Slice across the vessel here",
                      {"slice-across", std::to_string(branch) + "@" +
                                           exact_text(measure::nearest_fraction(*tree, branch, spot.place))});
    entries.entry("Copy place", {"copy-place", exact_text(spot.place.x) + "," + exact_text(spot.place.y) + "," +
                                                   exact_text(spot.place.z)});
    return entries.chosen;
}

} // namespace ramus::app
