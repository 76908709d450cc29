// Tool: what takes the left mouse button over the picture instead of turning the view: lassoing, placing, measuring.
// It is told what the pointer does, says what it wants drawn over the picture, and what comes out of it are command
// lines, as in a commands file, that its owner performs. It changes nothing itself, draws nothing itself, and knows no
// window: positions are pixels of the picture from the top left.
#pragma once

#include "app/assets/measured.h"
#include "app/session/document.h"
#include "app/tools/viewport_mouse.h"
#include "render/renderer/drawn.h"

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

// How the tools work, as the user set it: a matter of the interface, not of the session.
struct ToolSettings {
    bool lasso_any_part = false; // a branch is in with any part of it; else with at least half its length
    bool lasso_visible = false;  // only what is visible; else through the whole tree
};

// The pointer over the picture, and what a tool may ask about it.
struct Pointing {
    glm::dvec2 at{0.0};
    Modifiers modifiers; // those of the last press
    bool held = false;   // the left button is down
    glm::ivec2 size{1};  // of the picture
    float pixel_ratio = 1.0F;
    const Document& document; // its tree, marks and camera
    const ToolSettings& settings;
    // The branch and the point of its surface that is shown there: of tools that pick(), when they are told of presses,
    // moves and releases.
    render::Pick under{};
    LesionShapes lesions{}; // of the document's marks

    [[nodiscard]] const render::Pick& pick() const { return under; }
    [[nodiscard]] const render::Camera& camera() const { return document.session().camera; }
};

// What a tool wants drawn over the picture. Positions and radii are pixels of the picture, widths are points; colours
// are sRGB with straight alpha.
struct ToolDrawing {
    struct Line {
        std::vector<glm::dvec2> points;
        glm::vec4 colour{1.0F};
        float width = 1.5F;
        bool closed = false;
    };
    struct Area { // what lies inside by the even-odd rule; may cross itself
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
    struct Text { // on a dark ground, its upper left corner at `at`
        glm::dvec2 at{0.0};
        std::string text;
        glm::vec4 colour{1.0F};
    };
    std::vector<Area> areas; // drawn first, then lines, circles and texts
    std::vector<Line> lines;
    std::vector<Circle> circles;
    std::vector<Text> texts;
};

enum class Cursor { kArrow, kCross, kHand, kSideways, kLasso, kLassoPolygon };

class Tool {
public:
    using Event = void (Tool::*)(const Pointing&);

    Tool() = default;
    Tool(const Tool&) = delete;
    Tool& operator=(const Tool&) = delete;
    virtual ~Tool() = default;

    // The left button. The second press of a double-click comes as double_click() instead of press(). A move comes
    // whether the button is held or not; a release only after a press or double-click.
    virtual void press(const Pointing&) {}
    virtual void move(const Pointing&) {}
    virtual void release(const Pointing&) {}
    virtual void double_click(const Pointing& pointing) { press(pointing); }
    // A click with the right button that was no drag (which zooms). False: it means nothing here, a menu comes.
    virtual bool right_click(const Pointing&) { return false; }
    // Escape. True: something that had begun was given up. False: there was nothing; the tool is left.
    virtual bool escape() { return false; }

    // Whether it has to know what is under the pointer: then it is told of it once that is looked up.
    [[nodiscard]] virtual bool picks() const { return true; }

    // Whether something has begun that escape() would give up.
    [[nodiscard]] virtual bool busy() const { return false; }

    [[nodiscard]] virtual ToolDrawing drawing(const Pointing&) const { return {}; }
    [[nodiscard]] virtual Cursor cursor() const { return Cursor::kCross; }
    [[nodiscard]] virtual std::string hint() const = 0; // one line: what to do next
    // Whether the branch under the pointer is shown as it is without a tool.
    [[nodiscard]] virtual bool points_at_branches() const { return false; }

    // Of the session's measurements, one that is being changed: the tool draws it as it is now, the picture does not.
    [[nodiscard]] virtual std::optional<std::size_t> moved_measurement() const { return {}; }

    // What came out since the last call.
    [[nodiscard]] std::vector<CommandLine> take_commands() { return std::exchange(commands_, {}); }

protected:
    void command(CommandLine line) { commands_.push_back(std::move(line)); }

private:
    std::vector<CommandLine> commands_;
};

} // namespace ramus::app
