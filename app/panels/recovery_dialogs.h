// State of the dialogs for recovery, unsaved changes and quitting. draw_recovery_dialog(), draw_unsaved_dialog() and
// draw_quit_dialog() draw them.
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
        std::string problem; // why it cannot be read; empty: readable
    };
    bool open = false;
    bool failed = false;        // recovery failed: the error shown is about that
    std::vector<Entry> entries; // newest first

    // Opens the dialog if there are entries.
    void offer(std::vector<autosave::Slot> slots);
};

struct UnsavedDialog {
    std::function<void()> next; // empty: the dialog is closed
    [[nodiscard]] bool open() const { return next != nullptr; }
    void close() { next = nullptr; }
};

// Asks for confirmation to quit while a file is being written.
struct QuitDialog {
    std::string activity;       // "Exporting liver.stl"
    std::function<void()> next; // empty: the dialog is closed
    [[nodiscard]] bool open() const { return next != nullptr; }
    void close() { next = nullptr; }
};

// "just now", "3 minutes ago", "26 hours ago", "5 days ago".
[[nodiscard]] std::string ago_text(std::chrono::system_clock::duration since);

} // namespace ramus::app
