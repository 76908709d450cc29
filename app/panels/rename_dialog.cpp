// A field for the name of a branch, a system, an object of the scene or a saved view.
#include "app/panels/rename_dialog.h"

#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"

#include <algorithm>
#include <imgui.h>

namespace ramus::app {

void Rename::show(int id, const std::string& name, bool of_subtree) {
    branch = id;
    subtree = of_subtree;
    system = -1;
    kind.clear();
    view.reset();
    open = fresh = true;
    text.fill('\0');
    std::copy_n(name.begin(), std::min(name.size(), text.size() - 1), text.begin());
}

void Rename::show_system(int index, const std::string& name) {
    show(tree::kNoBranch, name);
    system = index;
}

void Rename::show_object(const std::string& object_kind, const std::string& object_number, const std::string& name) {
    show(tree::kNoBranch, name);
    kind = object_kind;
    number = object_number;
}

void Rename::show_view(const std::string& now, const std::string& proposed) {
    show(tree::kNoBranch, proposed);
    view = now;
}

static std::string title_of(const Rename& rename) {
    if (rename.view) return rename.view->empty() ? "Save this view" : "Name of the saved view";
    if (rename.system >= 0) return "Name of the system";
    return "Name of " +
           (rename.kind.empty() ? "branch " + std::to_string(rename.branch) : rename.kind + " " + rename.number);
}

static void take_name(InterfaceContext& context, const Rename& rename) {
    if (rename.view && rename.view->empty()) return context.perform("view-save", {rename.text.data()});
    if (rename.view) return context.perform("view-rename", {*rename.view, rename.text.data()});
    if (rename.system >= 0)
        return context.perform("name-system", {std::to_string(rename.system + 1), rename.text.data()});
    if (!rename.kind.empty()) return context.perform("object-name", {rename.kind, rename.number, rename.text.data()});
    std::vector<std::string> words{std::to_string(rename.branch), rename.text.data()};
    if (rename.subtree) words.emplace_back("subtree");
    context.perform("name", words);
}

// What the name means, below the field; whether it can be taken.
struct NameHint {
    std::string text;
    bool legal = true;
};

static NameHint hint_of(const Rename& rename, const Marks& marks) {
    if (rename.system >= 0) return {"The legend, tables and reports use it; the file that was read stays as it is."};
    if (!rename.view) return {"An empty name takes it away."};
    const std::string typed = rename.text.data();
    if (const auto good = check_view_name(typed); !good) return {capitalised(good.error().message()) + ".", false};
    if (typed == *rename.view || !has_view(marks.views, typed)) return {"View, Saved views goes back to it."};
    if (rename.view->empty()) return {"There is a saved view of this name: it is replaced."};
    return {"Another saved view has this name.", false};
}

void draw_rename(InterfaceContext& context) {
    Rename& rename = context.interface.of<Rename>();
    const Document& document = context.workspace.document();
    if (rename.open && rename.branch >= document.branch_count()) rename.open = false;
    if (!rename.open || !widgets::begin_dialog("##name", 380.0F, 0.0F)) return;
    const float scale = theme::scale();
    widgets::heading(title_of(rename).c_str());
    ImGui::Dummy({0.0F, 2.0F * scale});
    if (std::exchange(rename.fresh, false)) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1.0F);
    const bool done = ImGui::InputText("##text", rename.text.data(), rename.text.size(),
                                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    if (rename.branch != tree::kNoBranch) {
        ImGui::Checkbox("Also for all that depends on it", &rename.subtree);
        widgets::tooltip("Branches without a name of their own that depend on it are called so too");
    }
    const NameHint hint = hint_of(rename, document.marks());
    widgets::quiet_wrapped(hint.text.c_str());
    ImGui::Dummy({0.0F, 4.0F * scale});
    const float width = 90.0F * scale;
    widgets::align_right(2.0F * width + ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("Cancel", {width, 0.0F})) rename.open = false;
    ImGui::SameLine();
    ImGui::BeginDisabled(!hint.legal);
    const char* const words = rename.view && rename.view->empty() ? "Save" : "Name it";
    const bool pressed = ImGui::Button(words, {width, 0.0F});
    ImGui::EndDisabled();
    widgets::note_item("Gives it this name");
    rename.fresh = done && !hint.legal; // Enter has taken the keyboard out of the field
    if (pressed || (done && hint.legal)) {
        rename.open = false;
        take_name(context, rename);
    }
    if (!rename.open) ImGui::CloseCurrentPopup();
    widgets::end_dialog();
}

} // namespace ramus::app
