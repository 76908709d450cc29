#include "app/window/run_window.h"

#include "app/actions/script.h"
#include "app/panels/theme.h"
#include "app/session/session_file.h"
#include "app/storage/autosave.h"
#include "app/storage/settings.h"
#include "app/storage/tree_source.h"
#include "app/storage/user_folders.h"
#include "app/window/glfw_window.h"
#include "app/window/imgui_renderer.h"
#include "app/window/loop_watch.h"
#include "app/window/viewer.h"
#include "core/base/memory.h"
#include "core/base/printable.h"
#include "core/io/json_text.h"
#include "core/io/output_file.h"
#include "core/io/volumes/volume_file.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <future>
#include <imgui.h>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace ramus::app {

namespace {

// What a window shows, as one JSON object in a file: for scripts that drive it from outside and have to know when it is
// done. Written anew (whole or not at all) only when something differs.
class StatusFile {
public:
    explicit StatusFile(std::string path) : path_(std::move(path)) {}
    void update(const Viewer& viewer, const Workspace& workspace, const LoopWatch& watch); // nothing without a path

private:
    std::string path_, written_;
};

// What the lists of notes and of contacts say, and where one has gone from them; and what was measured.
void add_lists(nlohmann::json& status, const Interface& interface, const Workspace& workspace) {
    status["doctor"] = {{"open", interface.doctor.open}, {"note", interface.doctor.current + 1}};
    status["unsaid"] = interface.unsaid.open;
    status["warnings"] = {{"open", interface.warnings.open},
                          {"unread", interface.warnings.list.unread()},
                          {"count", interface.warnings.list.all().size()}};
    if (const auto& tree = workspace.document.tree())
        status["claims"] = {{"units", tree->claims.unit_word()}, {"orientation", tree->claims.axes_word()}};
    const auto& contacts = workspace.assets.contacts.list;
    status["contacts"] = {{"open", interface.contacts.open},
                          {"contact", interface.contacts.current + 1},
                          {"count", contacts ? static_cast<int>(contacts->size()) : -1}};
    const auto& findings = workspace.assets.validation.findings;
    status["validation"] = {{"open", interface.validation.open},
                            {"finding", interface.validation.current + 1},
                            {"count", findings && !workspace.validating() ? static_cast<int>(findings->size()) : -1}};
    const SurfaceDeviation& deviation = workspace.assets.deviation;
    status["deviation_measured"] = deviation.valued_mesh != nullptr && !workspace.measuring_deviation();
    status["deviation_most_mm"] = deviation.most_mm;
    status["measured"] = nlohmann::json::array();
    if (workspace.assets.measurements)
        for (const Result<Measured>& found : workspace.assets.measurements->found)
            status["measured"].push_back(found ? found->sentence() : found.error().message());
    if (const auto& facts = workspace.document.facts()) {
        status["radius_mm"] = {facts->statistics.radius_mm.min, facts->statistics.radius_mm.max};
        status["notes"] = workspace.document.tree()->notes.size();
    }
}

// Which dialogs are open.
void add_dialogs(nlohmann::json& status, const Interface& interface) {
    status["help"] = interface.help_open;
    status["palette"] = {{"open", interface.palette.open}, {"trouble", interface.palette.trouble}};
    status["menu"] = interface.menu_open || interface.context_menu.open;
    status["open_menu"] = interface.open_menu;
    status["light_theme"] = interface.settings.light_theme;
    status["open_dialog"] = interface.open_dialog.open;
    status["rename"] = interface.rename.open && !interface.rename.fresh;
    status["save_dialog"] = interface.open_dialog.open && interface.open_dialog.purpose == FilePurpose::kSave;
    const ExportChoice& choice = interface.open_dialog.exported;
    const bool exporting = interface.open_dialog.open && interface.open_dialog.purpose == FilePurpose::kExport;
    status["export"] = exporting ? std::string(choice.kind().key) + " " + choice.format().extension : "";
    status["unsaved_dialog"] = interface.unsaved.open();
    status["volume_dialog"] = {{"open", interface.volume.open()}, {"read", interface.volume.facts != nullptr}};
    status["recovery_dialog"] = interface.recovery.open;
    status["recoveries"] = interface.recovery.entries.size();
}

nlohmann::json to_json(const LoopWatch::Gap& gap) {
    return {{"seconds", gap.seconds},
            {"processor_seconds", gap.processor_seconds},
            {"doing", gap.doing},
            {"command", gap.command}};
}

void StatusFile::update(const Viewer& viewer, const Workspace& workspace, const LoopWatch& watch) {
    if (path_.empty()) return;
    const Layout& layout = viewer.layout();
    const Interface& interface = viewer.interface();
    nlohmann::json status = to_json(workspace.document.session(), "/");
    status["window"] = {layout.window.x, layout.window.y};
    status["viewport"] = {layout.view_at.x, layout.view_at.y, layout.view_size.x, layout.view_size.y};
    status["viewports"] = nlohmann::json::array();
    for (const glm::ivec2 at : layout.viewports_at)
        status["viewports"].push_back(
            {layout.view_at.x + at.x, layout.view_at.y + at.y, layout.viewport_size.x, layout.viewport_size.y});
    status["surface_ready"] = workspace.surface_ready();
    const ReadySurface& shown = workspace.shown();
    status["triangles"] = shown.mesh ? shown.mesh->triangle_count() : 0;
    const bool cones = shown.request.options.method == mesh::Method::kTruncatedCones;
    status["shown"] = !shown.mesh ? "nothing" : cones ? "cones" : shown.provisional ? "preview" : "surface";
    status["picture"] = {{"of", viewer.picture().cast() ? "centerlines" : "mesh"},
                         {"width", viewer.picture().pictured_width()},
                         {"refined", viewer.refined()}};
    status["problem"] = workspace.surface_problem();
    status["resting"] = viewer.resting();
    status["hovered"] = interface.hovered;
    status["nothing_in_view"] = interface.nothing_in_view;
    if (const auto& bar = viewer.picture().scale_bar())
        status["scale_bar"] = {{"mm", bar->length_mm}, {"pixels", bar->pixels}, {"at", render::name_of_place(bar->at)}};
    else
        status["scale_bar"] = nullptr;
    status["tooltip"] = interface.tooltip && interface.hovered != tree::kNoBranch;
    status["tool"] = interface.tool_kind->name;
    status["tool_busy"] = interface.tool && interface.tool->busy();
    status["last_command"] = interface.last_command;
    status["lasso"] = {{"mode", interface.tool_settings.lasso_any_part ? "any" : "half"},
                       {"depth", interface.tool_settings.lasso_visible ? "visible" : "through"}};
    status["tool_texts"] = nlohmann::json::array();
    for (const auto& text : interface.tool_drawing.texts) status["tool_texts"].push_back(text.text);
    status["planning"] = interface.page == PanelPage::kPlan;
    status["page"] = key_of(interface.page);
    status["branch_window"] = interface.list.apart;
    add_lists(status, interface, workspace);
    add_dialogs(status, interface);
    const Document& document = workspace.document;
    status["modified"] = document.modified();
    status["session_file"] = document.file().string();
    status["written"] = interface.written.open ? interface.written.file.string() : "";
    status["branch_count"] = document.branch_count();
    status["pieces"] = document.tree() ? document.tree()->roots.size() : 0;
    status["undo"] = document.can_undo() ? document.step_name(document.position() - 1) : "";
    status["redo"] = document.can_redo() ? document.step_name(document.position()) : "";
    status["typing"] = ImGui::GetIO().WantTextInput; // a field has the keyboard
    status["error"] = interface.errors.empty() ? "" : interface.errors.front().message();
    status["notice"] = interface.notice.text;
    status["longest_gap"] = to_json(watch.longest());
    if (viewer.controls()) status["controls"] = *viewer.controls();
    std::string text = io::printed_json(status, -1) + "\n";
    if (text == written_) return;
    written_ = std::move(text);
    (void)io::write_file(path_, written_); // a script that misses its file will say so
}

int complain(const Error& error) {
    std::cerr << "ramus: " << printable(error.message()) << '\n';
    return 1;
}

std::optional<std::filesystem::path> first_file(const WindowOptions& options) {
    if (!options.session.empty()) return options.session;
    if (!options.files.empty()) return options.files.front();
    return demo_tree();
}

// What outlives the window: the session, should the process be killed, and the settings.
class Keeper {
public:
    Keeper(const Settings& settings, bool own_scale)
        : written_(settings), own_scale_(own_scale), autosaver_(folder(), wake_window), writer_(wake_window) {}

    [[nodiscard]] static std::filesystem::path folder() {
        const std::filesystem::path state = user_folders::state();
        return state.empty() ? state : state / "autosave";
    }

    void update(GlfwWindow& window, Viewer& viewer, const Document& document, double now) {
        if (auto slot = viewer.files().take_recovered()) autosaver_.take_over(std::move(*slot));
        if (const auto error = autosaver_.update(document, now))
            viewer.warn(Warning{"Not kept for recovery: " + error->what, error->where, error->hint});
        Settings wanted = settings(window, viewer);
        if (!own_scale_) window.set_scale(static_cast<float>(wanted.ui_scale));
        if (wanted != wanted_) {
            wanted_ = wanted;
            changed_ = now;
        }
        writer_.drain();
        if (wanted_ == written_ || writer_.busy() || now < changed_ + kSettleSeconds) return;
        written_ = wanted_;
        writer_.start("Saving", [wanted](Job&, const Worker::Post&) {
            (void)write_settings(wanted, user_folders::settings()); // a convenience
        });
    }

    [[nodiscard]] double wait_seconds(double now) const {
        const double autosave = autosaver_.wait_seconds(now);
        return wanted_ == written_ ? autosave : std::min(autosave, std::max(0.0, changed_ + kSettleSeconds - now));
    }

    void leave(const GlfwWindow& window, const Viewer& viewer) {
        autosaver_.leave();
        while (writer_.busy()) {
            writer_.wait(std::chrono::milliseconds(50));
            writer_.drain();
        }
        if (const Settings last = settings(window, viewer); last != written_)
            (void)write_settings(last, user_folders::settings());
    }

private:
    static constexpr double kSettleSeconds = 1.0;

    [[nodiscard]] Settings settings(const GlfwWindow& window, const Viewer& viewer) const {
        Settings settings = viewer.files().settings();
        if (const auto size = window.size_points()) settings.window = *size;
        return settings;
    }

    Settings written_, wanted_ = written_;
    bool own_scale_; // the command line's
    double changed_ = 0.0;
    Autosaver autosaver_;
    Worker writer_;
};

// What surfaces were made in serves the next one, while somebody moves a slider; a window that is left alone gives it
// back.
class SpareMemory {
public:
    void update(bool busy, double now) {
        if (busy) {
            returned_ = false;
            idle_since_ = now;
        }
        if (!returned_ && now >= idle_since_ + kIdleSeconds) {
            release_unused_memory();
            returned_ = true;
        }
    }
    [[nodiscard]] double wait_seconds(double now) const {
        return returned_ ? std::numeric_limits<double>::infinity() : std::max(0.0, idle_since_ + kIdleSeconds - now);
    }

private:
    static constexpr double kIdleSeconds = 20.0;
    double idle_since_ = 0.0;
    bool returned_ = true;
};

Result<void> loop(GlfwWindow& window, Viewer& viewer, Workspace& workspace, Keeper& keeper,
                  const WindowOptions& options, std::optional<std::vector<ScriptLine>> script) {
    StatusFile status(options.status);
    SpareMemory spare_memory;
    LoopWatch watch;
    watch.looked();
    if (!options.status.empty()) viewer.note_controls();
    while (!viewer.files().closing()) {
        if (window.close_wanted()) {
            window.refuse_close();
            viewer.files().quit(); // asks first when something would be lost
            continue;
        }
        const bool drawn = viewer.draw(glfwGetTime(), 0);
        watch.did("draw");
        if (drawn) window.swap();
        watch.did("swap");
        if (script && workspace.surface_ready() && viewer.resting()) {
            viewer.set_script_runs(true);
            auto done = run_script(viewer.actions(), *std::exchange(script, std::nullopt), options.commands);
            viewer.set_script_runs(false);
            if (!done) return done;
            viewer.redraw();
            watch.looked(); // nobody is there to wait for a script
            continue;
        }
        window.set_title(viewer.title());
        window.set_cursor(viewer.input().cursor());
        status.update(viewer, workspace, watch);
        watch.did("status");
        keeper.update(window, viewer, workspace.document, glfwGetTime());
        watch.did("keep");
        const double now = glfwGetTime();
        spare_memory.update(workspace.busy() || viewer.commands().busy(), now);
        watch.did("spare memory");
        const CommandLine& last = viewer.interface().last_command;
        watch.looks(last.empty() ? std::string() : last.front());
        window.wait(std::min({viewer.wait_seconds(now), keeper.wait_seconds(now), spare_memory.wait_seconds(now)}));
        watch.looked();
    }
    return {};
}

} // namespace

int run_window(const WindowOptions& options) {
    std::optional<std::vector<ScriptLine>> script;
    if (!options.commands.empty()) {
        auto read = read_script(options.commands);
        if (!read) return complain(read.error());
        script = std::move(*read);
    }
    // The file is read while the display and the graphics driver get ready.
    Workspace workspace(wake_window);
    workspace.reading = options.read;
    Session empty;
    empty.marks.options = options.surface;
    workspace.document.open(nullptr, empty);
    const auto file = first_file(options);
    const bool asks = file && script == std::nullopt && io::is_volume(*file); // somebody says what becomes of it
    if (file && !asks) workspace.open(*file);
    if (!options.status.empty())
        if (auto possible = io::check_output(options.status); !possible) return complain(possible.error());

    const StoredSettings stored = read_settings(user_folders::settings());
    const Settings& settings = stored.settings;
    const bool own_scale = options.scale > 0.0F;
    const float wanted_scale = own_scale ? options.scale : static_cast<float>(settings.ui_scale);
    const ImguiContext imgui;
    auto fonts = std::async(std::launch::async, [scale = wanted_scale > 0.0F ? wanted_scale : 1.0F] {
        theme::apply(scale); // another scale of the display makes them anew
        ImGui::GetIO().Fonts->Build();
    });
    auto window = GlfwWindow::create(options.size.x > 0 ? options.size : settings.window, wanted_scale);
    if (!window) return complain(window.error());
    auto renderer = render::Renderer::create(render::kGlassBytes, options.graphics_bytes);
    if (!renderer) return complain(renderer.error());
    fonts.wait();
    auto viewer = Viewer::create(workspace, **renderer, (*window)->scale(), wake_window);
    if (!viewer) return complain(viewer.error());
    (*window)->attach(viewer->get());
    (*viewer)->resize((*window)->framebuffer_size(), (*window)->scale());
    if (options.files.size() > 1) (*viewer)->say("One tree at a time: only " + options.files.front() + " was opened");
    (*viewer)->files().use_settings(settings);
    if (asks) (*viewer)->files().ask_about_volume(*file);
    if (!stored.trouble.empty()) (*viewer)->say(stored.trouble);
    (*viewer)->files().offer(autosave::find_abandoned(Keeper::folder()));
    Keeper keeper(settings, own_scale);
    (*window)->show();
    const auto done = loop(**window, **viewer, workspace, keeper, options, std::move(script));
    keeper.leave(**window, **viewer);
    (*window)->attach(nullptr);
    return done ? 0 : complain(done.error());
}

} // namespace ramus::app
