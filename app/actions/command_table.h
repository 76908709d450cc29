// The table of everything that a user can do: name, key, help and action of each command. Menus, keys, `--commands`
// files, the help overlay and the tests read this one table.
//
// An action works on a Document, on the assets that belong to it (which it refreshes before it reads them) and, for
// what only a window or a renderer can do, on a Host. It checks its arguments before it changes anything: a command
// that fails leaves the document as it was.
#pragma once

#include "app/picture/fly_along.h"
#include "app/session/document.h"
#include "core/base/error.h"
#include "render/image/image.h"
#include "render/renderer/renderer.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct Command;
struct ToolSettings; // app/tools/tool.h
struct Assets;       // app/assets/assets.h

// What a command needs from its surroundings. The window implements all of it, `ramus render` what makes sense there.
class Host {
public:
    Host() = default;
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;
    virtual ~Host() = default;

    // Pixels; of pictures with several panes, of one of them.
    [[nodiscard]] virtual glm::ivec2 picture_size() const = 0;
    // What the picture shows; null: nothing.
    [[nodiscard]] virtual std::shared_ptr<const render::PagedMesh> picture_mesh() const = 0;
    // What the picture of the document as it is now shows in each pixel.
    virtual Result<render::BranchPicture> branch_picture();
    virtual Result<void> write_picture(const std::filesystem::path& path) = 0;
    // The session as another camera sees it, with scale bar and cube, for reports.
    virtual Result<render::Image> draw_picture(const render::Camera& camera, glm::ivec2 size);
    virtual void camera_leapt() {}    // the command set a camera far from the last: the eye wants to be led there
    virtual void flew(int, double) {} // along the vessels: to this branch, so far
    FlyPaths flights;
    virtual void say(const std::string& sentence); // what a command did, where it cannot be seen in the picture

    virtual Result<void> open(const std::filesystem::path& path);
    virtual Result<void> ask_for_file();
    virtual Result<void> ask_for_lesion_mesh();
    virtual Result<void> ask_for_context();
    // Whether this surface (app/assets/context_shapes.h) is about to be read by somebody else, who then runs `context`
    // with these arguments again.
    virtual bool reads_context(const ContextItem&, std::span<const std::string>) { return false; }
    virtual Result<void> ask_for_mask();
    // Whether a command may take its time: nobody waits for the next picture.
    [[nodiscard]] virtual bool unhurried() const { return true; }
    // Whether this mesh is about to be read by somebody else, who runs the command again once it is.
    virtual bool reads_lesion_mesh(const std::filesystem::path&) { return false; }
    virtual Result<void> ask_for_name();                // of a session, to save it
    virtual Result<void> toggle(std::string_view part); // "help", "panel"
    // Sets a part of the window that has more to it than being there: "overview" to "on", "generation", ...
    virtual Result<void> arrange(std::string_view part, std::string_view setting);
    [[nodiscard]] virtual bool shows(std::string_view) const { return false; } // that part
    virtual bool dismiss() { return false; } // closes what lies on top, if anything does
    virtual Result<void> quit();
    // The clipboard.
    virtual Result<void> copy_text(const std::string& text);
    virtual Result<std::string> pasted_text();
    // What runs that did not end well have left: the dialog for 0, else the n-th in it.
    virtual Result<void> recover(int which);
    virtual Result<void> discard_recovery(int which);
    virtual Result<void> set_ui_scale(double pixels_per_point); // 0: what the display says
    [[nodiscard]] virtual double ui_scale() const { return 1.0; }
    virtual Result<void> use_tool(std::string_view name);                      // one of tool_kinds()
    [[nodiscard]] virtual std::string_view tool() const { return "navigate"; } // the one in use
    virtual ToolSettings* tool_settings() { return nullptr; }                  // null: there is no mouse
};

struct ActionContext {
    Document& document;
    Host& host;
    Assets& assets;
};

using Arguments = std::span<const std::string>;

struct Command {
    std::string name;                // as in a commands file
    std::string arguments{};         // "ID...", "[FILE]", "NAME"; empty: none
    std::string help{};              // one sentence
    std::string menu{};              // menu that it is in; empty: none
    std::string label{};             // its text there
    std::vector<std::string> keys{}; // "Ctrl+Z"; the first one is shown in the menu
    Result<void> (*action)(ActionContext&, Arguments) = nullptr;
    std::vector<std::string> preset{};                             // arguments that the menu and the keys give
    bool (*enabled)(const Document&) = nullptr;                    // null: always
    std::function<bool(const Document&)> checked{};                // null: not a switch
    bool (*in_use)(Host&, const Command&) = nullptr;               // a switch of the interface, not of the document
    std::string (*label_now)(const Document&) = nullptr;           // the label, when it depends on the document
    [[nodiscard]] bool scripted() const { return preset.empty(); } // false: an entry that gives arguments to another
};

// In the order of menus and help. Several entries may have one name, with other presets: the views.
[[nodiscard]] const std::vector<Command>& command_table();
[[nodiscard]] const Command* find_command(std::string_view name);
[[nodiscard]] const Command* command_for_key(std::string_view key); // "Ctrl+Shift+Z"
[[nodiscard]] std::string label_of(const Command& command, const Document& document);

// The command as a line of a commands file, in the document's and host's hands. `words[0]` is the name. All that it
// changes is one step of undo, with a phrase for a name (app/actions/phrases.h).
[[nodiscard]] Result<void> run_command(ActionContext& context, std::span<const std::string> words);
// As the menu and the keys do.
[[nodiscard]] Result<void> run_entry(ActionContext& context, const Command& command);

} // namespace ramus::app
