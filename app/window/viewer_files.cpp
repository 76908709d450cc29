#include "app/window/viewer_files.h"

#include "app/panels/error_dialog.h"
#include "app/panels/help_overlay.h"
#include "app/panels/open_dialog.h"
#include "app/panels/recovery_dialogs.h"
#include "app/panels/volume_dialog.h"
#include "app/panels/welcome_panel.h"
#include "app/picture/video_file.h"
#include "app/storage/opening_files.h"
#include "app/storage/recent_files.h"
#include "app/storage/user_folders.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/recognise.h"
#include "core/io/trees/csv_pair.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace ramus::app {

void ViewerFiles::when_saved(std::function<void()> next) {
    state_.redraw();
    if (state_.script_runs || !state_.workspace.document().has_unsaved_work()) return next();
    state_.interface.of<Help>().open = false;
    state_.interface.of<OpenDialog>().open = false;
    state_.interface.of<UnsavedDialog>().next = std::move(next);
}

namespace {

// Whether the file is a table other than a tree's nodes or edges, and no other known format.
bool is_branch_table(const std::filesystem::path& path) {
    return can_be_table(path) && !io::recognised(path).by_content && !io::is_csv_pair(io::head_of(path));
}

} // namespace

// The next line of a script refers to this file: waits until everything is ready.
Result<void> ViewerFiles::open_and_wait(const std::filesystem::path& path, const io::ReadOptions& how) {
    Workspace& workspace = state_.workspace;
    workspace.open(path, how);
    do {
        workspace.update();
        if (const auto error = workspace.take_error()) return tl::unexpected(*error);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    } while (workspace.busy() || (!workspace.all_shown() && workspace.surface_problem().empty()));
    update();
    return {};
}

Result<void> ViewerFiles::open(const std::filesystem::path& path) {
    if (!state_.script_runs && state_.persons_window && io::is_volume(path)) {
        ask_about_volume(path);
        return {};
    }
    return open_as_tree(path, io::ReadOptions());
}

Result<void> ViewerFiles::open_as_tree(const std::filesystem::path& path, const io::ReadOptions& how) {
    if (state_.script_runs) return open_and_wait(path, how);
    // Context that is shown without a tree stays for the next tree.
    const bool stays = !state_.workspace.document().tree() && !is_session_file(path);
    const auto when = [&](std::function<void()> next) { stays ? next() : when_saved(std::move(next)); };
    when([this, path, how] {
        recovering_.clear();
        state_.workspace.open(path, how);
        state_.interface.of<ErrorDialog>().errors.clear();
        state_.interface.of<OpenDialog>().open = false;
        state_.redraw();
    });
    return {};
}

void ViewerFiles::ask_for_file(FilePurpose purpose) {
    Interface& interface = state_.interface;
    interface.of<Help>().open = false;
    if (purpose == FilePurpose::kSave) {
        interface.of<OpenDialog>().show_to_save(suggested_file(state_.workspace.document(), ".ramus.json"));
    } else if (purpose == FilePurpose::kExport) {
        const std::string extension = interface.of<OpenDialog>().exported.format().extension;
        interface.of<OpenDialog>().show_to_save(
            in_remembered(suggested_file(state_.workspace.document(), extension), purpose), purpose);
    } else if (purpose == FilePurpose::kRegion || purpose == FilePurpose::kRegionTree) {
        interface.of<OpenDialog>().show_to_save(suggested_file(state_.workspace.document(), "-region.nii.gz"), purpose);
    } else {
        const std::filesystem::path beside = state_.workspace.document().subject().parent_path();
        const std::filesystem::path opened = interface.settings.folder_of(key_of(FilePurpose::kOpen));
        interface.of<OpenDialog>().show(
            in_remembered((beside.empty() ? opened : beside) / "file", purpose).parent_path(), purpose);
    }
    state_.redraw();
}

// The file in the folder last used for this kind; never an existing file.
std::filesystem::path ViewerFiles::in_remembered(const std::filesystem::path& file, FilePurpose purpose) const {
    namespace fs = std::filesystem;
    const fs::path folder = state_.interface.settings.folder_of(key_of(purpose));
    std::error_code ignored;
    if (folder.empty() || !fs::is_directory(folder, ignored)) return file;
    fs::path free = folder / file.filename();
    for (int i = 2; fs::exists(free, ignored); ++i)
        free = folder / (file.stem().string() + "-" + std::to_string(i) + file.extension().string());
    return free;
}

void ViewerFiles::ask_for_export(std::string_view kind) {
    ExportChoice& choice = state_.interface.of<OpenDialog>().exported;
    if (const auto what = export_kind_named(kind)) choice.what = *what;
    choice.case_line = {}; // a patient's name must not stay for the next report
    choice.figure.window_size = state_.layout.view_size;
    choice.figure.window_text = state_.scale;
    choice.figure.videos = can_make_videos();
    ask_for_file(FilePurpose::kExport);
}

void ViewerFiles::quit() {
    const auto save_and_close = [this] { when_saved([this] { closing_ = true; }); };
    const std::string writing = state_.script_runs ? std::string() : state_.commands.writing();
    if (writing.empty()) return save_and_close();
    state_.interface.of<Help>().open = state_.interface.of<OpenDialog>().open = false;
    state_.interface.of<QuitDialog>() = {writing, save_and_close};
    state_.redraw();
}

void ViewerFiles::dropped(const std::filesystem::path& path) {
    const bool is_mesh = io::is_mesh(path), planning = state_.interface.page == PanelPage::kPlan;
    Interface& interface = state_.interface;
    const Document& document = state_.workspace.document();
    if (document.tree() && is_branch_table(path)) {
        state_.perform("data", {path.string()});
    } else if (io::is_volume(path)) {
        interface.of<Help>().open = interface.of<OpenDialog>().open = false;
        ask_about_volume(path);
    } else {
        state_.perform(!is_mesh ? "open" : planning ? "lesion-mesh" : "context", {path.string()});
    }
    state_.redraw();
}

void ViewerFiles::ask_about_volume(const std::filesystem::path& path) {
    VolumeDialog& dialog = state_.interface.of<VolumeDialog>();
    dialog = {};
    dialog.file = path;
    const bool beside = state_.interface.settings.drop_beside && state_.workspace.document().branch_count() > 0;
    dialog.as = beside ? VolumeDialog::As::kContext : VolumeDialog::As::kTree;
    volume_read_ = path;
    const auto memory = static_cast<double>(state_.workspace.document().marks().options.memory_bytes);
    volume_reader_.start(
        "Reading " + path.filename().string(),
        [this, path, memory, how = state_.workspace.reading_of(path)](Job& job, const Worker::Post& post) {
            auto facts = read_volume_facts(path, how, memory, job);
            if (!job.cancelled()) post([this, facts = std::move(facts)] { take_volume_facts(facts); });
        });
    state_.redraw();
}

void ViewerFiles::ask_about_context(const std::filesystem::path& file) {
    ask_about_volume(file);
    state_.interface.of<VolumeDialog>().as = VolumeDialog::As::kContext;
    state_.interface.of<VolumeDialog>().asked = true;
}

// A file that cannot be read cannot be opened either.
void ViewerFiles::take_volume_facts(const Result<VolumeFacts>& facts) {
    VolumeDialog& dialog = state_.interface.of<VolumeDialog>();
    if (facts) {
        dialog.take(*facts);
    } else {
        dialog = {};
        state_.interface.of<ErrorDialog>().errors.push_back(facts.error());
    }
    state_.redraw();
}

void ViewerFiles::follow_dialogs() {
    if (state_.interface.of<OpenDialog>().listing.update()) state_.redraw();
    volume_reader_.drain();
    if (const std::string why = volume_reader_.take_failure(); !why.empty())
        take_volume_facts(fail("the file cannot be read: " + why, volume_read_.string(), "give a smaller one"));
    if (!volume_reader_.busy()) return;
    if (state_.interface.of<VolumeDialog>().file != volume_read_) volume_reader_.cancel(); // answered or closed
    if (std::exchange(state_.interface.of<VolumeDialog>().progress, volume_reader_.progress()) !=
        volume_reader_.progress())
        state_.redraw();
}

// Asks once; closing the dialog discards the file.
void ViewerFiles::ask_about_arrival() {
    Workspace& workspace = state_.workspace;
    if (state_.commands.awaits()) return; // a pending click may create work that would be lost
    if (workspace.arrival_waits() && !state_.interface.of<UnsavedDialog>().next) {
        if (std::exchange(asked_about_arrival_, true))
            workspace.discard_arrival();
        else
            when_saved([&workspace] { workspace.accept_arrival(); });
    }
    if (!workspace.arrival_waits()) asked_about_arrival_ = false;
}

void ViewerFiles::update() {
    follow_dialogs();
    ask_about_arrival();
    if (const auto opened = state_.workspace.take_opened()) take(*opened);
    remember(state_.workspace.document().file()); // a session that was saved
    while (const auto error = state_.workspace.take_error()) {
        state_.interface.of<ErrorDialog>().errors.push_back(*error);
        // An entry that cannot be recovered may be discarded, or left for later.
        RecoveryDialog& recovery = state_.interface.of<RecoveryDialog>();
        recovery.failed = !std::exchange(recovering_, std::filesystem::path()).empty();
        recovery.open = recovery.open || recovery.failed;
    }
}

void ViewerFiles::remember(const std::filesystem::path& file) {
    if (!state_.persons_window || file.empty() || std::exchange(remembered_, file) == file) return;
    Interface& interface = state_.interface;
    interface.recent_files = remember_file(file, static_cast<std::size_t>(interface.settings.recent_files));
}

void ViewerFiles::take(const Workspace::Opened& opened) {
    opened_(opened);
    Interface& interface = state_.interface;
    remember(opened.path);
    if (state_.persons_window) interface.settings.folders[key_of(FilePurpose::kOpen)] = opened.path.parent_path();
    auto& entries = interface.of<RecoveryDialog>().entries;
    const auto entry = std::ranges::find(entries, recovering_, [](const auto& each) { return each.slot.file(); });
    if (opened.recovered && entry != entries.end()) {
        recovered_.emplace(std::move(entry->slot));
        entries.erase(entry);
        state_.say("Recovered; not saved yet");
    }
    recovering_.clear();
}

void ViewerFiles::use_settings(const Settings& settings) {
    state_.persons_window = true;
    state_.interface.settings = settings;
    state_.interface.panel_open = settings.panel_open;
    state_.redraw();
}

Settings ViewerFiles::settings() const {
    Settings settings = state_.interface.settings;
    settings.panel_open = state_.interface.panel_open;
    return settings;
}

void ViewerFiles::welcome() {
    Interface& interface = state_.interface;
    if (interface.settings.welcome) interface.show_left<Welcome>();
}

void ViewerFiles::offer(std::vector<autosave::Slot> abandoned) {
    state_.interface.of<RecoveryDialog>().offer(std::move(abandoned));
    state_.redraw();
}

Result<RecoveryDialog::Entry*> ViewerFiles::recovery(int which) {
    auto& entries = state_.interface.of<RecoveryDialog>().entries;
    if (entries.empty()) return fail("there is nothing to recover");
    if (which < 1 || which > static_cast<int>(entries.size()))
        return fail("there is no entry " + std::to_string(which), {},
                    "they go from 1 to " + std::to_string(entries.size()));
    return &entries[static_cast<std::size_t>(which - 1)];
}

Result<void> ViewerFiles::recover(int which) {
    RAMUS_TRY(entry, recovery(std::max(which, 1)));
    state_.redraw();
    if (which == 0) {
        state_.interface.of<RecoveryDialog>().open = true;
        return {};
    }
    if (!entry->problem.empty()) return fail(entry->problem, entry->slot.file().string());
    when_saved([this, snapshot = entry->snapshot, file = entry->slot.file()] {
        state_.interface.of<RecoveryDialog>().open = false;
        recovering_ = file;
        state_.workspace.recover(snapshot);
        state_.redraw();
    });
    return {};
}

Result<void> ViewerFiles::discard_recovery(int which) {
    RAMUS_TRY(entry, recovery(which));
    RecoveryDialog& dialog = state_.interface.of<RecoveryDialog>();
    if (entry->slot.file() == recovering_) return fail("it is being recovered");
    entry->slot.remove();
    dialog.entries.erase(dialog.entries.begin() + (which - 1));
    dialog.open = dialog.open && !dialog.entries.empty();
    state_.redraw();
    return {};
}

} // namespace ramus::app
