// What the dialogs about the life of a session remember: what other runs left behind, and what is to happen once
// unsaved changes have been seen to. The dialogs themselves are drawn by draw_recovery_dialog() and
// draw_unsaved_dialog().
#pragma once

#include "app/storage/autosave.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ramus::app {

struct RecoveryDialog {
    struct Entry {
        autosave::Slot slot;
        autosave::Snapshot snapshot;
        std::string problem; // why it cannot be read; empty: it can
    };
    bool open = false;
    bool failed = false;        // what was chosen could not be recovered: the error that is shown is about it
    std::vector<Entry> entries; // newest first

    // Shows itself when there is anything.
    void offer(std::vector<autosave::Slot> slots);
};

struct UnsavedDialog {
    std::function<void()> next; // empty: the dialog is closed
    [[nodiscard]] bool open() const { return next != nullptr; }
};

// A file is still being written when somebody wants to quit.
struct QuitDialog {
    std::string activity;       // "Exporting liver.stl"
    std::function<void()> next; // empty: the dialog is closed
    [[nodiscard]] bool open() const { return next != nullptr; }
};

// "just now", "3 minutes ago", "26 hours ago", "5 days ago".
[[nodiscard]] std::string ago_text(std::chrono::system_clock::duration since);

} // namespace ramus::app
