// Tool: handles the left mouse button over the picture instead of navigation: lasso, placing, measuring. It receives
// pointer events, returns what to draw over the picture, and produces command lines, as in a commands file, for its
// owner to run. It does not change the document, does not draw and knows no window. Positions are pixels of the picture
// from the top left.
#pragma once

#include "app/assets/measured.h"
#include "app/session/document.h"
#include "app/tools/viewport_mouse.h"
#include "core/slice/pixel_grid.h"
#include "render/renderer/drawn.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

using CommandLine = std::vector<std::string>; // the command's name, then its arguments

// User settings of tools; part of the interface, not of the session.
struct ToolSettings {
    bool lasso_any_part = false; // any part of a branch suffices; false: at least half its length
    bool lasso_visible = false;  // only visible parts; false: the whole tree
    double cut_radius_mm = 3.0;  // of balls that cut a region of a scan
};

// A slice under the pointer.
struct SlicePointing {
    slice::PixelGrid grid;
    render::Camera camera; // looks at it: its pixels are those of the grid
    double reach_mm = 0.0; // what is farther from the plane is not on the slice
};

// The pointer over the picture, and data that a tool may query.
struct Pointing {
    glm::dvec2 at{0.0};
    Modifiers modifiers; // of the last press
    bool held = false;   // the left button is down
    glm::ivec2 size{1};  // of the picture
    float pixel_ratio = 1.0F;
    const Document& document; // its tree, marks and camera
    const ToolSettings& settings;
    // The branch and surface point under the pointer; set for tools that pick(), in press, move and release events.
    render::Pick under{};
    LesionShapes lesions{};               // of the document's marks
    std::optional<SlicePointing> slice{}; // `at` and `size` are its pixels; none: the tree is under the pointer

    [[nodiscard]] const render::Pick& pick() const { return under; }
    [[nodiscard]] const render::Camera& camera() const { return slice ? slice->camera : document.session().camera; }
    // Whether a pick shows a place of the scan: on a slice, or on a slice among the vessels.
    [[nodiscard]] bool on_scan(const render::Pick& pick) const { return slice || pick.plane != render::kNoPlane; }
    // Whether a place can be seen and grabbed here: on a slice, only what is near its plane.
    [[nodiscard]] bool shows(const glm::dvec3& place) const {
        return !slice || std::abs(slice->grid.plane().height(place)) <= slice->reach_mm;
    }
};

// What to draw over the picture. Positions and radii are pixels of the picture, widths are points; colours are sRGB
// with straight alpha.
struct ToolDrawing {
    struct Line {
        std::vector<glm::dvec2> points;
        glm::vec4 colour{1.0F};
        float width = 1.5F;
        bool closed = false;
    };
    struct Area { // filled by the even-odd rule; may cross itself
        std::vector<glm::dvec2> outline;
        glm::vec4 colour{1.0F};
    };
    struct Circle {
        glm::dvec2 at{0.0};
        double radius = 4.0;
        glm::vec4 colour{1.0F};
        float width = 1.5F;
        bool filled = false;
    };
    struct Text { // on a dark background, its upper left corner at `at`
        glm::dvec2 at{0.0};
        std::string text;
        glm::vec4 colour{1.0F};
    };
    struct Part {
        glm::ivec2 at{0}, size{1};
    };
    std::optional<Part> part; // of the picture that it is over; none: each viewport that shows the tree
    std::vector<Area> areas;  // drawn first, then lines, circles and texts
    std::vector<Line> lines;
    std::vector<Circle> circles;
    std::vector<Text> texts;
};

enum class WorksOn : std::uint8_t { kTree, kSlices, kBoth };
enum class Cursor { kArrow, kCross, kHand, kSideways, kLasso, kLassoPolygon };

class Tool {
public:
    using Event = void (Tool::*)(const Pointing&);

    Tool() = default;
    Tool(const Tool&) = delete;
    Tool& operator=(const Tool&) = delete;
    virtual ~Tool() = default;

    // Events of the left button. The second press of a double-click arrives as double_click() instead of press(). Moves
    // arrive with and without the button; a release only after a press or double-click.
    virtual void press(const Pointing&) {}
    virtual void move(const Pointing&) {}
    virtual void release(const Pointing&) {}
    virtual void double_click(const Pointing& pointing) { press(pointing); }
    // A click with the right button (dragging it zooms). False: not used, the context menu opens.
    virtual bool right_click(const Pointing&) { return false; }
    // Escape. True: something in progress was cancelled. False: nothing was; the owner leaves the tool.
    virtual bool escape() { return false; }

    // Ctrl and the wheel over a slice, and the keys + and -; a notch away from the person is 1. False: not used, and
    // the picture is magnified.
    virtual bool step(double /*notches*/, const ToolSettings& /*settings*/) { return false; }

    // Whether events need Pointing::under; they then arrive after the pick.
    [[nodiscard]] virtual bool picks() const { return true; }

    // Whether something is in progress that escape() would cancel.
    [[nodiscard]] virtual bool busy() const { return false; }

    [[nodiscard]] virtual ToolDrawing drawing(const Pointing&) const { return {}; }
    [[nodiscard]] virtual Cursor cursor() const { return Cursor::kCross; }
    [[nodiscard]] virtual std::string hint() const = 0; // one line: what to do next
    // Where the tool has the left button; elsewhere it turns the tree, or moves the crosshair of slices, as without a
    // tool.
    [[nodiscard]] virtual WorksOn works_on() const { return WorksOn::kTree; }
    // Whether the branch under the pointer is highlighted as without a tool.
    [[nodiscard]] virtual bool points_at_branches() const { return false; }

    // Whether the commands until this is false again are one step of undo: something is dragged and changes on the way.
    [[nodiscard]] virtual bool changes_while_held() const { return false; }

    // Index of the measurement that is being changed: the tool draws it instead of the picture.
    [[nodiscard]] virtual std::optional<std::size_t> moved_measurement() const { return {}; }

    // The command lines produced since the last call.
    [[nodiscard]] std::vector<CommandLine> take_commands() { return std::exchange(commands_, {}); }

protected:
    void command(CommandLine line) { commands_.push_back(std::move(line)); }

private:
    std::vector<CommandLine> commands_;
};

} // namespace ramus::app
