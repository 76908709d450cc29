// What a Viewer does about files: opening and saving, what was left by other runs, and what it asks before work is
// lost.
#include "app/storage/places.h"
#include "app/storage/recent_files.h"
#include "app/window/viewer.h"

#include <algorithm>
#include <chrono>
#include <imgui.h>
#include <thread>

namespace ramus::app {

void Viewer::take_opened(const Workspace::Opened& opened) {
    if (!opened.has_camera && picture_mesh())
        workspace_.document.set_camera(
            render::camera_for(picture_mesh()->positions(), render::View::kAnterior, picture_size()));
    glide_.reset();
    interface_.hovered = tree::kNoBranch;
    interface_.list.of = nullptr;
    interface_.list.shown = interface_.list.cursor = interface_.list.anchor = tree::kNoBranch;
    interface_.overview.shown_selection = tree::kNoBranch;
    interface_.overview.layout_of = nullptr;
    interface_.rename.open = interface_.fly.open = interface_.fly.playing = false;
    (void)use_tool(tool()); // what it had begun was about the other tree
    if (keeps_files_) {
        remember_file(opened.path, static_cast<std::size_t>(interface_.settings.recent_files));
        interface_.settings.last_folder = opened.path.parent_path();
    }
    auto& entries = interface_.recovery.entries;
    const auto entry = std::ranges::find(entries, recovering_, [](const auto& each) { return each.slot.file(); });
    if (opened.recovered && entry != entries.end()) {
        recovered_.emplace(std::move(entry->slot));
        entries.erase(entry);
        say("Recovered; not saved yet");
    }
    recovering_.clear();
    pick_wanted_ = true;
    shake();
}

void Viewer::use_settings(const Settings& settings) {
    keeps_files_ = true;
    interface_.settings = settings;
    interface_.panel_open = settings.panel_open;
    shake();
}

Settings Viewer::settings() const {
    Settings settings = interface_.settings;
    settings.panel_open = interface_.panel_open;
    return settings;
}

void Viewer::when_saved(std::function<void()> next) {
    shake();
    if (unattended_ || !workspace_.document.has_unsaved_work()) return next();
    interface_.help_open = false;
    interface_.open_dialog.open = false;
    interface_.unsaved.next = std::move(next);
}

// The next line of a script is about this file: it waits until all is there.
Result<void> Viewer::open_and_wait(const std::filesystem::path& path) {
    workspace_.open(path);
    do {
        workspace_.update();
        if (const auto error = workspace_.take_error()) return tl::unexpected(*error);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    } while (workspace_.busy() || (!workspace_.surface_ready() && workspace_.surface_problem().empty()));
    take_news();
    return {};
}

Result<void> Viewer::open(const std::filesystem::path& path) {
    if (unattended_) return open_and_wait(path);
    when_saved([this, path] {
        recovering_.clear();
        workspace_.open(path);
        interface_.errors.clear();
        interface_.open_dialog.open = false;
        shake();
    });
    return {};
}

Result<void> Viewer::quit() {
    when_saved([this] { closing_ = true; });
    return {};
}

Result<void> Viewer::ask_for_file() {
    interface_.help_open = false;
    const std::filesystem::path beside = workspace_.document.session().tree.path.parent_path();
    interface_.open_dialog.show(beside.empty() ? interface_.settings.last_folder : beside);
    shake();
    return {};
}

Result<void> Viewer::ask_for_lesion_mesh() {
    (void)ask_for_file();
    interface_.open_dialog.purpose = OpenDialog::Purpose::kLesionMesh;
    return {};
}

Result<void> Viewer::ask_for_mask() {
    (void)ask_for_file();
    interface_.open_dialog.purpose = OpenDialog::Purpose::kMask;
    return {};
}

bool Viewer::reads_lesion_mesh(const std::filesystem::path& path) {
    if (unhurried() || reread_mesh_) return false;
    workspace_.read_lesion_mesh(path);
    return true;
}

Result<void> Viewer::ask_for_context() {
    (void)ask_for_file();
    interface_.open_dialog.purpose = OpenDialog::Purpose::kContext;
    return {};
}

bool Viewer::reads_context(const ContextItem& item, std::span<const std::string> arguments) {
    if (unhurried() || reread_mesh_) return false;
    workspace_.context.read(source_of(item), {arguments.begin(), arguments.end()});
    return true;
}

Result<void> Viewer::ask_for_name() {
    interface_.help_open = false;
    interface_.open_dialog.show_to_save(suggested_file(workspace_.document, ".ramus.json"));
    shake();
    return {};
}

Result<void> Viewer::copy_text(const std::string& text) {
    ImGui::SetClipboardText(text.c_str());
    return {};
}

Result<std::string> Viewer::pasted_text() {
    const char* text = ImGui::GetClipboardText();
    if (text == nullptr || *text == '\0') return fail("there is no text on the clipboard");
    return std::string(text);
}

void Viewer::offer(std::vector<autosave::Slot> abandoned) {
    interface_.recovery.offer(std::move(abandoned));
    shake();
}

Result<RecoveryDialog::Entry*> Viewer::recovery(int which) {
    auto& entries = interface_.recovery.entries;
    if (entries.empty()) return fail("there is nothing to recover");
    if (which < 1 || which > static_cast<int>(entries.size()))
        return fail("there is no entry " + std::to_string(which), {},
                    "they go from 1 to " + std::to_string(entries.size()));
    return &entries[static_cast<std::size_t>(which - 1)];
}

Result<void> Viewer::recover(int which) {
    const auto entry = recovery(std::max(which, 1));
    if (!entry) return tl::unexpected(entry.error());
    shake();
    if (which == 0) {
        interface_.recovery.open = true;
        return {};
    }
    if (!(*entry)->problem.empty()) return fail((*entry)->problem, (*entry)->slot.file().string());
    when_saved([this, snapshot = (*entry)->snapshot, file = (*entry)->slot.file()] {
        interface_.recovery.open = false;
        recovering_ = file;
        workspace_.recover(snapshot);
        shake();
    });
    return {};
}

Result<void> Viewer::discard_recovery(int which) {
    const auto entry = recovery(which);
    if (!entry) return tl::unexpected(entry.error());
    RecoveryDialog& dialog = interface_.recovery;
    if ((*entry)->slot.file() == recovering_) return fail("it is being recovered");
    (*entry)->slot.remove();
    dialog.entries.erase(dialog.entries.begin() + (which - 1));
    dialog.open = dialog.open && !dialog.entries.empty();
    shake();
    return {};
}

Result<void> Viewer::set_ui_scale(double pixels_per_point) {
    interface_.settings.ui_scale = pixels_per_point;
    shake();
    return {};
}

} // namespace ramus::app
