// ViewerFiles: opening files, what was left by other runs, and what is asked before work is lost.
#pragma once

#include "app/storage/recent_files.h"
#include "app/window/viewer_state.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace ramus::app {

class ViewerFiles final : public FileHost {
public:
    // `opened` is called when a tree came in, before anything else is done with it.
    ViewerFiles(ViewerState& state, std::function<void(const Workspace::Opened&)> opened)
        : state_(state), opened_(std::move(opened)) {
        state.interface.recent_files = read_recent_files();
    }

    Result<void> open(const std::filesystem::path& path) override;
    void ask_for_file(FilePurpose purpose) override;
    Result<void> recover(int which) override;
    Result<void> discard_recovery(int which) override;
    void quit() override;

    void dropped(const std::filesystem::path& path);
    void update(); // takes files that have been read, and what could not be
    [[nodiscard]] bool closing() const { return closing_; }

    // What lives longer than the window: see run_window.cpp.
    void use_settings(const Settings& settings);
    [[nodiscard]] Settings settings() const;
    void offer(std::vector<autosave::Slot> abandoned);
    // What was recovered since the last call, to be taken over.
    [[nodiscard]] std::optional<autosave::Slot> take_recovered() { return std::exchange(recovered_, std::nullopt); }

private:
    void when_saved(std::function<void()> next);
    Result<void> open_and_wait(const std::filesystem::path& path);
    void ask_about_arrival();
    void take(const Workspace::Opened& opened);
    [[nodiscard]] Result<RecoveryDialog::Entry*> recovery(int which);

    ViewerState& state_;
    std::function<void(const Workspace::Opened&)> opened_;
    bool closing_ = false;
    bool asked_about_arrival_ = false;
    std::filesystem::path recovering_; // the file of the recovery that is being read; empty: none is
    std::optional<autosave::Slot> recovered_;
};

} // namespace ramus::app
