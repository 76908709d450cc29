#include "app/panels/recovery_dialogs.h"

#include "app/panels/error_dialog.h"
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "app/storage/user_folders.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

void RecoveryDialog::offer(std::vector<autosave::Slot> slots) {
    for (autosave::Slot& slot : slots) {
        auto snapshot = slot.read();
        if (snapshot && snapshot->changes == 0) { // older versions also saved sessions without changes
            slot.remove();
            continue;
        }
        const std::string trouble = snapshot ? std::string{} : snapshot.error().what;
        entries.push_back({std::move(slot), std::move(snapshot).value_or(autosave::Snapshot{}), trouble});
    }
    open = !entries.empty();
}

std::string ago_text(std::chrono::system_clock::duration since) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since).count();
    const auto many = [](std::int64_t count, const char* one, const char* more) {
        return counted(static_cast<std::uint64_t>(count), one, more) + " ago";
    };
    if (seconds < 60) return "just now";
    if (seconds < 60 * 60) return many(seconds / 60, "minute", "minutes");
    if (seconds < 48 * 60 * 60) return many(seconds / (60 * 60), "hour", "hours");
    return many(seconds / (24 * 60 * 60), "day", "days");
}

namespace {

std::string title_of(const RecoveryDialog::Entry& entry) {
    if (!entry.problem.empty()) return entry.slot.file().filename().string();
    const auto& file = entry.snapshot.file;
    return (file.empty() ? subject_of(entry.snapshot.session) : file).filename().string();
}

std::string about(const RecoveryDialog::Entry& entry) {
    if (!entry.problem.empty()) return entry.problem;
    return counted(entry.snapshot.changes, "change", "changes") + ", " +
           ago_text(std::chrono::system_clock::now() - entry.snapshot.saved);
}

enum class RecoveryChoice { kNone, kRecover, kDiscard };

RecoveryChoice draw_entry(const RecoveryDialog::Entry& entry, float height) {
    const float scale = theme::scale();
    const float button = 90.0F * scale;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const ImVec2 at = ImGui::GetCursorPos();
    const float text_width = ImGui::GetContentRegionAvail().x - 2.0F * button - 3.0F * gap;
    ImGui::TextUnformatted(widgets::fitted(title_of(entry), text_width).c_str());
    widgets::tooltip(entry.problem.empty() ? subject_of(entry.snapshot.session).c_str() : entry.slot.file().c_str());
    widgets::quiet(widgets::fitted(about(entry), text_width).c_str());
    const ImVec2 end = ImGui::GetCursorPos();
    ImGui::SetCursorPos({at.x, std::round(at.y + 0.5F * (height - ImGui::GetFrameHeight()))});
    widgets::align_right(2.0F * button + gap);
    RecoveryChoice choice = RecoveryChoice::kNone;
    if (ImGui::Button("Discard", {button, 0.0F})) choice = RecoveryChoice::kDiscard;
    ImGui::SameLine();
    ImGui::BeginDisabled(!entry.problem.empty());
    if (widgets::button("Recover", {button, 0.0F}, theme::kAccentDim)) choice = RecoveryChoice::kRecover;
    ImGui::EndDisabled();
    ImGui::SetCursorPos(end);
    return choice;
}

} // namespace

void draw_recovery_dialog(InterfaceContext& context) {
    RecoveryDialog& dialog = context.interface.of<RecoveryDialog>();
    // Errors and unsaved changes come first.
    if (!dialog.open || !context.interface.of<ErrorDialog>().errors.empty() ||
        context.interface.of<UnsavedDialog>().open())
        return;
    if (!widgets::begin_dialog("recovery", 560.0F, 0.0F)) return;
    const float scale = theme::scale();
    widgets::heading("ramus did not close properly");
    ImGui::Dummy({0.0F, 2.0F * scale});
    widgets::quiet_wrapped(dialog.entries.size() == 1 ? "This session was not saved:"
                                                      : "These sessions were not saved:");
    ImGui::Dummy({0.0F, 4.0F * scale});
    const float row = 2.0F * ImGui::GetTextLineHeightWithSpacing();
    const float gap = 8.0F * scale;
    constexpr std::size_t kShownRows = 5;
    const auto rows = static_cast<float>(std::min(dialog.entries.size(), kShownRows));
    std::vector<std::string> chosen;
    ImGui::BeginChild("entries", {0.0F, rows * (row + gap)});
    for (std::size_t i = 0; i < dialog.entries.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const RecoveryChoice choice = draw_entry(dialog.entries[i], row);
        if (choice != RecoveryChoice::kNone)
            chosen = {choice == RecoveryChoice::kRecover ? "recover" : "discard-recovery", std::to_string(i + 1)};
        ImGui::Dummy({0.0F, gap - ImGui::GetStyle().ItemSpacing.y});
        ImGui::PopID();
    }
    ImGui::EndChild();
    widgets::quiet_wrapped("Everything comes back except the steps of undo.");
    ImGui::Dummy({0.0F, 4.0F * scale});
    const float width = 90.0F * scale;
    widgets::align_right(width);
    const bool later = ImGui::Button("Later", {width, 0.0F});
    widgets::tooltip("They stay, and are offered again: File, Recover...");
    // Return recovers a single entry; the Return key that opened the dialog does not count.
    if (!ImGui::IsWindowAppearing() && dialog.entries.size() == 1 && dialog.entries[0].problem.empty() &&
        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false))
        chosen = {"recover", "1"};
    if (later) dialog.open = false;
    if (!chosen.empty()) context.perform(chosen[0], {chosen[1]});
    if (!dialog.open || context.interface.of<UnsavedDialog>().open()) ImGui::CloseCurrentPopup();
    widgets::end_dialog();
}

void draw_unsaved_dialog(InterfaceContext& context) {
    UnsavedDialog& dialog = context.interface.of<UnsavedDialog>();
    if (!dialog.open() || !context.interface.of<ErrorDialog>().errors.empty()) return;
    if (!widgets::begin_dialog("unsaved", 520.0F, 0.0F)) return;
    const float scale = theme::scale();
    const Document& document = context.workspace.document();
    const std::filesystem::path target = suggested_file(document, ".ramus.json");
    widgets::heading("Save the changes first?");
    ImGui::Dummy({0.0F, 2.0F * scale});
    const std::size_t changes = document.unsaved_changes();
    const std::string text =
        counted(changes, "change", "changes") + " to " + document.subject().filename().string() + " would be lost.";
    ImGui::TextWrapped("%s", text.c_str());
    widgets::quiet_wrapped(("Save writes " + target.string()).c_str());
    ImGui::Dummy({0.0F, 6.0F * scale});
    const float width = 90.0F * scale;
    widgets::align_right(3.0F * width + 2.0F * ImGui::GetStyle().ItemSpacing.x);
    // The key that opened the dialog does not answer it.
    const auto pressed = [](int key) { return !ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(key, false); };
    constexpr int kD = 'D'; // as GLFW numbers it
    const bool discard = ImGui::Button("Discard", {width, 0.0F}) || pressed(kD);
    widgets::tooltip("Forget the changes", "D");
    ImGui::SameLine();
    const bool cancel = ImGui::Button("Cancel", {width, 0.0F});
    ImGui::SameLine();
    const bool save =
        widgets::button("Save", {width, 0.0F}, theme::kAccentDim) || pressed(ImGui::GetKeyIndex(ImGuiKey_Enter));
    if (discard || cancel || save) {
        const auto next = std::exchange(dialog.next, nullptr);
        ImGui::CloseCurrentPopup();
        if (save) context.perform("save", {target.string()});
        if (discard || (save && !document.has_unsaved_work())) next();
    }
    widgets::end_dialog();
}

void draw_quit_dialog(InterfaceContext& context) {
    QuitDialog& dialog = context.interface.of<QuitDialog>();
    if (!dialog.open() || !context.interface.of<ErrorDialog>().errors.empty()) return;
    // Writing may finish while the dialog is open.
    const bool done = context.commands.writing().empty();
    if (!widgets::begin_dialog("quit", 460.0F, 0.0F)) return;
    const float scale = theme::scale(), width = 110.0F * scale;
    widgets::heading("A file is still being written");
    ImGui::Dummy({0.0F, 2.0F * scale});
    widgets::quiet_wrapped((dialog.activity + " is not finished. If you quit now, it is not written.").c_str());
    ImGui::Dummy({0.0F, 6.0F * scale});
    widgets::align_right(2.0F * width + ImGui::GetStyle().ItemSpacing.x);
    const bool quit = ImGui::Button("Quit anyway", {width, 0.0F});
    ImGui::SameLine();
    const bool wait = widgets::button("Wait", {width, 0.0F}, theme::kAccentDim) ||
                      (!ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false));
    if (quit || wait || done) {
        const auto next = std::exchange(dialog.next, nullptr);
        ImGui::CloseCurrentPopup();
        if (!wait) next();
    }
    widgets::end_dialog();
}

} // namespace ramus::app
