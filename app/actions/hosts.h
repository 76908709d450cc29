// What commands need from their surroundings beside the document, one class for each role. The window fills every role;
// `ramus render` has the picture alone.
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

struct ToolSettings; // app/tools/tool.h

// What was asked for and may not be there yet.
template <class Value> struct Deferred {
    std::function<bool()> ready; // does not wait
    std::function<Value()> take; // once; waits
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

    // Pixels; of pictures with several viewports, of one of them.
    [[nodiscard]] virtual glm::ivec2 picture_size() const = 0;
    [[nodiscard]] virtual glm::ivec2 whole_size() const { return picture_size(); } // with all viewports
    // What the picture shows; null: nothing.
    [[nodiscard]] virtual std::shared_ptr<const render::PagedMesh> picture_mesh() const = 0;
    virtual Result<void> write_picture(const std::filesystem::path& path) = 0; // as PNG
    // The files of a picture for a paper, a slide or a video, of the document as it is.
    virtual Result<void> write_figure(const FigureRequest& request, Job& job);
    // Where a window must not wait for what draws long: work for another thread that does what these words, a command's
    // name first, do, in a program of its own with the document as it is now. Else nothing, and it is done here.
    [[nodiscard]] virtual Result<std::function<Result<void>(Job&)>>
    done_elsewhere(const std::vector<std::string>& /*words*/) {
        return std::function<Result<void>(Job&)>();
    }
    // Which branch each pixel shows, of the document as it is now.
    virtual Result<render::BranchPicture> branch_picture();
    // The same, and what write_picture() writes, where a window must not wait for what another thread draws; any thread
    // may take the second. Nothing: write_picture() does it.
    [[nodiscard]] virtual Deferred<Result<render::BranchPicture>> deferred_branch_picture() {
        return known_now(branch_picture());
    }
    [[nodiscard]] virtual std::optional<Deferred<Result<render::Image>>> deferred_picture() { return {}; }
    // The document from another camera, with scale bar and cube, dressed as `options` say, for reports.
    virtual Result<render::Image> draw_picture(const render::Camera& camera, glm::ivec2 size,
                                               const FigureOptions& options);
    // A command has moved the camera at once: a window shows the way from the last one.
    virtual void camera_leapt() {}
    // What the middle of the picture shows, or what is nearest to it there; none: nobody looks, or nothing is in view.
    [[nodiscard]] virtual std::optional<glm::dvec3> looked_at() { return {}; }
    // A command has put the camera on its way along the vessels to the end of `branch`, at this fraction of it.
    virtual void flew(int /*branch*/, double /*fraction*/) {}
    FlyPaths flights;
};

enum class FilePurpose { kOpen, kSave, kLesionMesh, kContext, kData, kMask, kDeviation, kExport };

// Files that replace the document, and the dialogs that ask for files.
class FileHost {
public:
    virtual ~FileHost() = default;
    virtual Result<void> open(const std::filesystem::path& path) = 0; // of a mask asks what becomes of it
    // Read like that; of a mask or a scan nobody is asked what becomes of it.
    virtual Result<void> open_as_tree(const std::filesystem::path& path, const io::ReadOptions& /*how*/) {
        return open(path);
    }
    // What of a mask or a scan is to be context: asks somebody, where asks().
    virtual void ask_about_context(const std::filesystem::path& /*file*/) {}
    // Shows the dialog; the command that belongs to the purpose follows with the file.
    virtual void ask_for_file(FilePurpose purpose) = 0;
    [[nodiscard]] virtual bool asks() const { return false; } // somebody is there who is asked before a file is written
    // The dialog for what leaves the program, at the page of a kind (app/actions/export_kinds.h); empty: as it was.
    virtual void ask_for_export(std::string_view /*kind*/) { ask_for_file(FilePurpose::kExport); }
    // What runs that did not end well have left: 0 shows the dialog, n brings its n-th entry back.
    virtual Result<void> recover(int which) = 0;
    virtual Result<void> discard_recovery(int which) = 0;
    virtual void quit() = 0; // asks first when something would be lost
};

// The parts of the window around the picture.
class WindowHost {
public:
    virtual ~WindowHost() = default;
    // "help", "palette", "menu", "overview", "doctor", "orientation", "warnings", "contacts", "validation", "branches",
    // "panel"; "explore", "surface", "plan" and "other" open a page of the panel.
    virtual void toggle(std::string_view part) = 0;
    [[nodiscard]] virtual bool shows(std::string_view part) const = 0; // those, and "fly-along"
    virtual void set_overview(std::string_view setting) = 0;           // "on", "off", "generation", "distance"
    virtual void open_flight(int branch) = 0;                          // the bar that flies to its end
    virtual void close_flight() = 0;
    virtual void ask_for_name(int branch) = 0;
    // The name of an object of the scene, by its kind and its number; `object-name` follows with it.
    virtual void ask_for_object_name(const std::string& /*kind*/, const std::string& /*number*/,
                                     const std::string& /*now*/) {}
    virtual void ask_for_radius() = 0;            // of the selected branches
    virtual void show_note(int /*note*/) {}       // in the import doctor's list, and in the picture
    virtual void show_contact(int /*contact*/) {} // in the list of contacts, and in the picture
    virtual void read_warnings() {}               // all of them
    virtual void show_finding(int /*finding*/) {} // in the validation's list
    // A command has written this file, or this many files that begin with it: says so, and offers the folder.
    virtual void wrote(const std::filesystem::path& /*file*/, const std::string& /*sentence*/) {}
    [[nodiscard]] virtual std::filesystem::path written() const { return {}; } // the last of them; empty: none
    virtual bool dismiss() = 0;                             // closes what lies on top; false: nothing does
    virtual void set_ui_scale(double pixels_per_point) = 0; // 0: what the display says
    [[nodiscard]] virtual double ui_scale() const = 0;      // pixels per point
    virtual void set_light_theme(bool light) = 0;           // else the dark one
    [[nodiscard]] virtual bool light_theme() const = 0;
    virtual void set_ground(Ground ground) = 0; // behind the tree
    [[nodiscard]] virtual Ground ground() const = 0;
};

class Clipboard {
public:
    virtual ~Clipboard() = default;
    virtual void copy_text(const std::string& text) = 0;
    [[nodiscard]] virtual Result<std::string> pasted_text() const = 0; // fails when there is none
};

// The tool that has the left mouse button over the picture.
class ToolHost {
public:
    virtual ~ToolHost() = default;
    virtual void use_tool(std::string_view name) = 0; // one of tool_kinds()
    [[nodiscard]] virtual std::string_view tool() const = 0;
    [[nodiscard]] virtual ToolSettings& tool_settings() = 0;
};

} // namespace ramus::app
