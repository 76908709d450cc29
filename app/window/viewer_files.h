// ViewerFiles: opens files, recovers work of crashed runs, and asks before work is lost.
#pragma once

#include "app/panels/open_dialog.h"
#include "app/panels/recovery_dialogs.h"
#include "app/panels/volume_dialog.h"
#include "app/storage/recent_files.h"
#include "app/window/viewer_state.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace ramus::app {

class ViewerFiles final : public FileHost {
public:
    // `opened`: called when a tree was opened, before anything else happens with it.
    ViewerFiles(ViewerState& state, std::function<void(const Workspace::Opened&)> opened)
        : state_(state), opened_(std::move(opened)), volume_reader_(state.wake) {
        state.interface.recent_files = read_recent_files();
        state.interface.of<OpenDialog>().listing.wake_by(state.wake);
    }

    Result<void> open(const std::filesystem::path& path) override;
    Result<void> open_as_tree(const std::filesystem::path& path, const io::ReadOptions& how) override;
    void ask_about_context(const std::filesystem::path& file) override;
    void ask_for_file(FilePurpose purpose) override;
    void ask_for_export(std::string_view kind) override;
    [[nodiscard]] bool asks() const override { return state_.watched(); }
    Result<void> recover(int which) override;
    Result<void> discard_recovery(int which) override;
    void quit() override;

    void dropped(const std::filesystem::path& path);
    void ask_about_volume(const std::filesystem::path& path);                   // asks how to use a mask or a scan
    [[nodiscard]] bool reading_volume() const { return volume_reader_.busy(); } // for that dialog
    void update(); // takes files that were read, and errors
    [[nodiscard]] bool closing() const { return closing_; }

    // State that outlives the window; see run_window.cpp.
    void use_settings(const Settings& settings);
    [[nodiscard]] Settings settings() const;
    void welcome(); // shows the welcome panel, unless dismissed earlier
    void offer(std::vector<autosave::Slot> abandoned);
    // A slot recovered since the last call, for the autosaver to take over.
    [[nodiscard]] std::optional<autosave::Slot> take_recovered() { return std::exchange(recovered_, std::nullopt); }

private:
    [[nodiscard]] std::filesystem::path in_remembered(const std::filesystem::path& file, FilePurpose purpose) const;
    void when_saved(std::function<void()> next);
    Result<void> open_and_wait(const std::filesystem::path& path, const io::ReadOptions& how);
    void ask_about_arrival();
    void take(const Workspace::Opened& opened);
    void remember(const std::filesystem::path& file); // adds to the recent files, except twice in a row
    [[nodiscard]] Result<RecoveryDialog::Entry*> recovery(int which);

    ViewerState& state_;
    std::function<void(const Workspace::Opened&)> opened_;
    bool closing_ = false;
    bool asked_about_arrival_ = false;
    void take_volume_facts(const Result<VolumeFacts>& facts);
    void follow_dialogs();
    std::filesystem::path remembered_; // the last remembered file
    std::filesystem::path recovering_; // the recovery file being read; empty: none
    std::optional<autosave::Slot> recovered_;
    std::filesystem::path volume_read_; // the file of the current or last dialog
    Worker volume_reader_;              // last: its thread ends first
};

} // namespace ramus::app
