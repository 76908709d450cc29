// Hosts: interfaces by which commands use their surroundings, one class per role. The window implements all roles;
// `ramus render` only the picture.
#pragma once

#include "app/picture/figure_options.h"
#include "app/picture/fly_along.h"
#include "app/picture/ground.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/imported_tree.h"
#include "render/image/image.h"
#include "render/renderer/drawn.h"

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

struct Session;      // app/session/session.h
struct ToolSettings; // app/tools/tool.h

// A value that may not be available yet.
template <class Value> struct Deferred {
    std::function<bool()> ready; // does not block
    std::function<Value()> take; // call once; blocks
};
template <class Value> [[nodiscard]] Deferred<Value> known_now(Value value) {
    auto kept = std::make_shared<Value>(std::move(value));
    return {[] { return true; }, [kept] { return std::move(*kept); }};
}

// The picture of the document.
class PictureHost {
public:
    PictureHost() = default;
    PictureHost(const PictureHost&) = delete;
    PictureHost& operator=(const PictureHost&) = delete;
    virtual ~PictureHost() = default;

    // Pixels, of one viewport.
    [[nodiscard]] virtual glm::ivec2 picture_size() const = 0;
    [[nodiscard]] virtual glm::ivec2 whole_size() const { return picture_size(); } // of all viewports
    // The mesh in the picture; null: none.
    [[nodiscard]] virtual std::shared_ptr<const render::PagedMesh> picture_mesh() const = 0;
    // The surface of the document's current state; fails while a window has not computed it yet.
    [[nodiscard]] virtual Result<std::shared_ptr<const render::PagedMesh>> current_mesh() { return picture_mesh(); }
    virtual Result<void> write_picture(const std::filesystem::path& path) = 0; // as PNG
    // Writes the files of a figure (picture, video) of the document's current state.
    virtual Result<void> write_figure(const FigureRequest& request, Job& job);
    // For windows, which must not block: returns work for another thread that runs this command (name first) in a
    // separate process on the document's current state. An empty function means that the caller must do it here.
    [[nodiscard]] virtual Result<std::function<Result<void>(Job&)>>
    detached_work(const std::vector<std::string>& /*words*/) {
        return std::function<Result<void>(Job&)>();
    }
    // The branch at each pixel, for the document's current state.
    virtual Result<render::BranchPicture> branch_picture();
    // Deferred versions of branch_picture() and of the image for write_picture(), for windows whose picture another
    // thread draws; any thread may take the second. None: use write_picture().
    [[nodiscard]] virtual Deferred<Result<render::BranchPicture>> deferred_branch_picture() {
        return known_now(branch_picture());
    }
    [[nodiscard]] virtual std::optional<Deferred<Result<render::Image>>> deferred_picture() { return {}; }
    // Draws the document as this session of its tree shows it, with scale bar and cube and with `options`, for reports.
    virtual Result<render::Image> draw_picture(const Session& session, glm::ivec2 size, const FigureOptions& options);
    // Called after a command moved the camera at once; windows animate the transition.
    virtual void camera_leapt() {}
    // The point shown in the middle of the picture, or the one nearest to it; none: nothing in view, or no viewer.
    [[nodiscard]] virtual std::optional<glm::dvec3> looked_at() { return {}; }
    // Called after a command moved the camera to this fraction of the flight to the end of `branch`.
    virtual void flew(int /*branch*/, double /*fraction*/) {}
    FlyPaths flights;
};

enum class FilePurpose {
    kOpen,
    kSave,
    kLesionMesh,
    kLesionMask,
    kContext,
    kData,
    kMask,
    kDeviation,
    kOrgan,
    kScan,
    kRegion,     // saves the region of a scan
    kRegionTree, // the same, and opens it as a tree
    kExport
};

// Opens files and shows file dialogs.
class FileHost {
public:
    virtual ~FileHost() = default;
    virtual Result<void> open(const std::filesystem::path& path) = 0; // asks how to use a mask
    // Opens a file with these options; does not ask how to use a mask or a scan.
    virtual Result<void> open_as_tree(const std::filesystem::path& path, const io::ReadOptions& /*how*/) {
        return open(path);
    }
    // Asks which part of a mask or scan becomes context, if asks().
    virtual void ask_about_context(const std::filesystem::path& /*file*/) {}
    // Shows a file dialog; the purpose's command then runs with the file.
    virtual void ask_for_file(FilePurpose purpose) = 0;
    [[nodiscard]] virtual bool asks() const { return false; } // a person can confirm overwriting
    // Shows the export dialog at this kind (app/actions/export_kinds.h); empty: the last one.
    virtual void ask_for_export(std::string_view /*kind*/) { ask_for_file(FilePurpose::kExport); }
    // Recovers what crashed runs have left: 0 shows the dialog, n recovers its n-th entry.
    virtual Result<void> recover(int which) = 0;
    virtual Result<void> discard_recovery(int which) = 0;
    virtual void quit() = 0; // asks first if work would be lost
};

// The parts of the window around the picture.
class WindowHost {
public:
    virtual ~WindowHost() = default;
    // "help", "palette", "menu", "overview", "doctor", "orientation", "warnings", "contacts", "validation", "branches",
    // "panel"; "explore", "surface", "plan" and "other" open a page of the panel.
    virtual void toggle(std::string_view part) = 0;
    [[nodiscard]] virtual bool shows(std::string_view part) const = 0; // these parts, and "fly-along"
    virtual void set_overview(std::string_view setting) = 0;           // "on", "off", "generation", "distance"
    virtual void open_flight(int branch) = 0;                          // shows the bar for flying to its end
    virtual void close_flight() = 0;
    virtual void ask_for_name(int branch) = 0;
    // Asks for the name of an object of the scene, by kind and number; the command `object-name` then runs.
    virtual void ask_for_object_name(const std::string& /*kind*/, const std::string& /*number*/,
                                     const std::string& /*now*/) {}
    // Asks for the name of a saved view; the command `view-rename` then runs. Empty: asks how to call the view as it
    // is, for `view-save`.
    virtual void ask_for_view_name(const std::string& /*now*/) {}
    virtual void ask_for_radius() = 0;            // for the selected branches
    virtual void show_note(int /*note*/) {}       // in the import doctor and in the picture
    virtual void show_contact(int /*contact*/) {} // in the list of contacts, and in the picture
    virtual void read_warnings() {}               // marks all as read
    virtual void show_finding(int /*finding*/) {} // in the list of the validation
    // Called after a command wrote a file or a series of files beginning with it: reports it and offers the folder.
    virtual void wrote(const std::filesystem::path& /*file*/, const std::string& /*sentence*/) {}
    [[nodiscard]] virtual std::filesystem::path written() const { return {}; } // the last file written; empty: none
    virtual bool dismiss() = 0;                             // closes the topmost panel or dialog; false: none is open
    virtual void set_ui_scale(double pixels_per_point) = 0; // 0: the display's value
    [[nodiscard]] virtual double ui_scale() const = 0;      // pixels per point
    virtual void set_light_theme(bool light) = 0;           // false: dark
    [[nodiscard]] virtual bool light_theme() const = 0;
    virtual void set_ground(Ground ground) = 0; // background
    [[nodiscard]] virtual Ground ground() const = 0;
};

class Clipboard {
public:
    virtual ~Clipboard() = default;
    virtual void copy_text(const std::string& text) = 0;
    [[nodiscard]] virtual Result<std::string> pasted_text() const = 0; // fails if there is no text
};

// Selects the tool for the left mouse button over the picture.
class ToolHost {
public:
    virtual ~ToolHost() = default;
    virtual void use_tool(std::string_view name) = 0; // one of tool_kinds()
    [[nodiscard]] virtual std::string_view tool() const = 0;
    [[nodiscard]] virtual ToolSettings& tool_settings() = 0;
};

} // namespace ramus::app
