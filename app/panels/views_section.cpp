// The saved views of the planning page.
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/theme.h"

#include <string>
#include <vector>

namespace ramus::app {

void draw_saved_views(InterfaceContext& context) {
    if (!draw_section(context, "Saved views", {{"Save", "Save this view under a name", "view-save"}})) return;
    const std::vector<SavedView> views = context.workspace.document().marks().views; // a copy: rows change the list
    for (std::size_t i = 0; i < views.size(); ++i) {
        const SavedView& view = views[i];
        ImGui::PushID(static_cast<int>(i));
        const std::string help = view.name + ": a click looks from there, a double click names it";
        const int done = plan_rows::removable_row(view.name, theme::kText, help.c_str());
        const bool twice = done > 0 && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        ImGui::PopID();
        if (done < 0)
            context.perform("view-delete", {view.name});
        else if (done > 0)
            context.perform(twice ? "view-rename" : "view-go", {view.name});
    }
}

} // namespace ramus::app
