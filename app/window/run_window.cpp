#include "app/window/run_window.h"

#include "app/actions/script.h"
#include "app/panels/theme.h"
#include "app/session/session_file.h"
#include "app/storage/autosave.h"
#include "app/storage/opening_files.h"
#include "app/storage/settings.h"
#include "app/storage/user_folders.h"
#include "app/window/drawing_thread.h"
#include "app/window/glfw_window.h"
#include "app/window/imgui_renderer.h"
#include "app/window/shown_picture.h"
#include "app/window/status_file.h"
#include "app/window/tick_watch.h"
#include "app/window/viewer.h"
#include "core/base/memory.h"
#include "core/base/own_process.h"
#include "core/base/printable.h"
#include "core/base/worker.h"
#include "core/io/output_file.h"
#include "core/io/volumes/volume_file.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <future>
#include <imgui.h>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace ramus::app {

namespace {

int complain(const Error& error) {
    std::cerr << "ramus: " << printable(error.message()) << '\n';
    return 1;
}

std::optional<std::filesystem::path> named_file(const WindowOptions& options) {
    if (!options.session.empty()) return options.session;
    if (!options.files.empty()) return options.files.front();
    return {};
}

// Keeps what outlives the window: the session, in case the process is killed, and the settings.
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

// Keeps freed memory for the next surface while a person moves a slider; returns it to the system when the window is
// idle.
class SpareMemory {
public:
    void update(bool busy, double now) {
        returner_.drain();
        if (busy) {
            returned_ = false;
            idle_since_ = now;
        }
        if (!returned_ && now >= idle_since_ + kIdleSeconds) {
            returner_.start("Giving back memory", [](Job&, const Worker::Post&) { release_unused_memory(); });
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
    Worker returner_{[] {}}; // returning much memory takes the system long
};

// Owns the renderer of a drawing thread and destroys it on that thread. Without a thread, a driver that cannot draw
// reports it at once.
class ThreadRenderer {
public:
    explicit ThreadRenderer(DrawingThread& thread) : thread_(thread) {}
    ~ThreadRenderer() {
        thread_.run([this] { renderer_.reset(); });
    }
    ThreadRenderer(const ThreadRenderer&) = delete;
    ThreadRenderer& operator=(const ThreadRenderer&) = delete;

    [[nodiscard]] Result<void> make(std::size_t surface_bytes) {
        if (thread_.has_thread()) {
            renderer_ = render::Renderer::create_later(render::kGlassBytes, surface_bytes);
            return {};
        }
        RAMUS_TRY(made, render::Renderer::create(render::kGlassBytes, surface_bytes));
        renderer_ = std::move(made);
        return {};
    }
    [[nodiscard]] render::Renderer& get() { return *renderer_; }

private:
    DrawingThread& thread_;
    std::unique_ptr<render::Renderer> renderer_;
};

Result<void> loop(GlfwWindow& window, Viewer& viewer, Workspace& workspace, Keeper& keeper,
                  const WindowOptions& options, std::vector<ScriptLine> script, TickWatch& watch) {
    StatusFile status(options.status);
    SpareMemory spare_memory;
    watch.waits();
    bool script_begun = false;
    std::size_t next_line = 0; // of the script: one line per frame, so that everything else continues
    viewer.set_script_left(!script.empty());
    if (!options.status.empty()) viewer.note_controls();
    while (!viewer.files().closing()) {
        if (window.close_wanted()) {
            window.refuse_close();
            viewer.input().close(); // asks first when something would be lost
            continue;
        }
        const bool drawn = viewer.draw(glfwGetTime(), 0);
        watch.did("draw");
        if (drawn) window.swap();
        watch.did("swap");
        script_begun |= workspace.all_shown() && viewer.resting();
        if (script_begun && next_line < script.size()) {
            viewer.set_script_runs(true);
            auto done = run_line(viewer.actions(), script[next_line++], options.commands, options.overwrite);
            viewer.set_script_runs(false);
            viewer.set_script_left(next_line < script.size());
            if (!done) return done;
            viewer.redraw();
            watch.waits(); // scripts do not count as waiting
        }
        window.set_title(viewer.title());
        window.set_cursor(viewer.input().cursor());
        watch.did("title");
        status.update(viewer, workspace, watch);
        watch.spare();
        keeper.update(window, viewer, workspace.document(), glfwGetTime());
        watch.did("keep");
        const double now = glfwGetTime();
        spare_memory.update(workspace.busy() || viewer.commands().busy(), now);
        watch.did("spare memory");
        const CommandLine& last = viewer.interface().last_command;
        watch.ends(last.empty() ? std::string() : last.front());
        status.look_for_question();
        watch.waits();
        const bool goes_on = script_begun && next_line < script.size();
        window.wait(goes_on ? 0.0
                            : std::min({viewer.wait_seconds(now), keeper.wait_seconds(now),
                                        spare_memory.wait_seconds(now), status.wait_seconds()}));
        watch.did("events");
    }
    return {};
}

} // namespace

int run_window(const WindowOptions& options) {
    start_fork_server();
    std::vector<ScriptLine> script;
    if (!options.commands.empty()) {
        auto read = read_script(options.commands);
        if (!read) return complain(read.error());
        script = std::move(*read);
    }
    // Reads the file while the display and the graphics driver start.
    Workspace workspace(wake_window);
    Session empty;
    empty.marks.options = options.surface;
    workspace.document().open(nullptr, empty);
    const auto named = named_file(options);
    const auto file = named ? named : demo_tree();
    workspace.say_reading(options.read, named.value_or(std::filesystem::path()));
    // Somebody says what becomes of a mask or a scan, unless the options say how a tree is made of it.
    const bool asks =
        file && options.commands.empty() && io::is_volume(*file) && options.read.mask == io::MaskReading();
    if (file && !asks) workspace.open(*file);
    if (!options.status.empty())
        if (auto possible = io::check_output(options.status); !possible) return complain(possible.error());

    const StoredSettings stored = read_settings(user_folders::settings());
    const Settings& settings = stored.settings;
    const bool own_scale = options.scale > 0.0F;
    const float wanted_scale = own_scale ? options.scale : static_cast<float>(settings.ui_scale);
    const ImguiContext imgui;
    auto fonts = std::async(std::launch::async, [scale = wanted_scale > 0.0F ? wanted_scale : 1.0F] {
        theme::apply(scale); // another scale of the display rebuilds them
        ImGui::GetIO().Fonts->Build();
    });
    auto window = GlfwWindow::create(options.size.x > 0 ? options.size : settings.window, wanted_scale);
    if (!window) return complain(window.error());
    const std::unique_ptr<DrawingThread> thread = (*window)->make_drawing_thread();
    ThreadRenderer renderer(*thread);
    if (auto made = renderer.make(options.graphics_bytes); !made) return complain(made.error());
    if (thread->has_thread()) ShownPicture::prepare();
    fonts.wait();
    TickWatch watch;
    auto viewer = Viewer::create(workspace, renderer.get(), (*window)->scale(), wake_window, thread.get());
    if (!viewer) return complain(viewer.error());
    (*viewer)->tell_steps([&watch](const char* step) { watch.did(step); });
    (*window)->attach(viewer->get());
    (*viewer)->resize((*window)->framebuffer_size(), (*window)->scale());
    if (options.files.size() > 1) (*viewer)->say("One tree at a time: only " + options.files.front() + " was opened");
    (*viewer)->files().use_settings(settings);
    if (!named) (*viewer)->files().welcome();
    if (asks) (*viewer)->files().ask_about_volume(*file);
    if (!stored.trouble.empty()) (*viewer)->say(stored.trouble);
    (*viewer)->files().offer(autosave::find_abandoned(Keeper::folder()));
    Keeper keeper(settings, own_scale);
    (*window)->show();
    const auto done = loop(**window, **viewer, workspace, keeper, options, std::move(script), watch);
    (*window)->hide(); // pending drawing must finish first
    keeper.leave(**window, **viewer);
    (*window)->attach(nullptr);
    return done ? 0 : complain(done.error());
}

} // namespace ramus::app
