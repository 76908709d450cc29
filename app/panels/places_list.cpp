#include "app/panels/places_list.h"

#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/storage/user_folders.h"

#include <imgui.h>
#include <system_error>

namespace ramus::app {

namespace fs = std::filesystem;

fs::path draw_places(float width, std::span<const fs::path> recent_files) {
    fs::path chosen;
    ImGui::BeginChild("places", {width, 0.0F});
    widgets::quiet("Places");
    const auto entry = [&](const char* label, const fs::path& path) {
        if (ImGui::Selectable(label)) chosen = path;
        widgets::tooltip(path.c_str());
    };
    if (const fs::path home = user_folders::home(); !home.empty()) entry("Home", home);
    if (const fs::path documents = user_folders::documents(); !documents.empty()) entry("Documents", documents);
    std::error_code ignored;
    entry("Here", fs::current_path(ignored));
    entry("Computer", "/");
    if (!recent_files.empty()) {
        ImGui::Dummy({0.0F, 6.0F * theme::scale()});
        widgets::quiet("Recent");
    }
    for (const fs::path& file : recent_files) {
        ImGui::PushID(file.c_str());
        entry(widgets::fitted(file.filename().string(), width - 12.0F * theme::scale()).c_str(), file);
        ImGui::PopID();
    }
    ImGui::EndChild();
    return chosen;
}

} // namespace ramus::app
