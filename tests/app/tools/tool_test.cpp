#include "app/actions/command_table.h"
#include "app/tools/lasso_tool.h"
#include "app/tools/tool_kinds.h"
#include "app/tools/tool_mouse.h"

#include <doctest/doctest.h>
#include <set>

using namespace ramus;
using namespace ramus::app;

namespace {

// Writes down what it is told.
class Diary final : public Tool {
public:
    void press(const Pointing& p) override { note("press", p); }
    void move(const Pointing& p) override { note(p.held ? "drag" : "move", p); }
    void release(const Pointing& p) override { note("release", p); }
    void double_click(const Pointing& p) override { note("double", p); }
    [[nodiscard]] std::string hint() const override { return "."; }

private:
    void note(const std::string& what, const Pointing& p) {
        command({what + (p.modifiers.shift ? "+shift" : "") + (p.pick().branch == 7 ? "@7" : "")});
    }
};

struct Hand {
    Document document;
    ToolSettings settings;
    ToolMouse mouse;
    Pointing at(double x, double y, Modifiers modifiers = {}) {
        return {.at = {x, y},
                .modifiers = modifiers,
                .size = {400, 300},
                .document = document,
                .settings = settings,
                .under = render::Pick{x > 100.0 ? 7 : tree::kNoBranch, {}}};
    }
    static ToolMouse::Tell tell(Tool& tool) {
        return [&tool](Tool::Event event, const Pointing& pointing) { (tool.*event)(pointing); };
    }
    void click(Tool& tool, double x, double y, double seconds, Modifiers modifiers = {}) {
        mouse.press(tell(tool), at(x, y, modifiers), seconds);
        mouse.release(tell(tool), at(x, y));
    }
};

std::vector<std::string> words(Tool& tool) {
    std::vector<std::string> all;
    for (const CommandLine& line : tool.take_commands()) all.insert(all.end(), line.begin(), line.end());
    return all;
}
using Words = std::vector<std::string>;

} // namespace

TEST_CASE("a tool receives presses, drags, releases and double-clicks, with the object under the pointer") {
    Hand hand;
    Diary tool;
    hand.mouse.move(Hand::tell(tool), hand.at(10, 10));
    hand.mouse.press(Hand::tell(tool), hand.at(10, 10, {.shift = true}), 1.0);
    CHECK(hand.mouse.held());
    hand.mouse.move(Hand::tell(tool), hand.at(120, 10));
    hand.mouse.release(Hand::tell(tool), hand.at(120, 10));
    hand.mouse.release(Hand::tell(tool), hand.at(120, 10)); // one that was not pressed here
    CHECK(words(tool) == Words{"move", "press+shift", "drag+shift@7", "release+shift@7"});
    hand.click(tool, 50, 50, 5.0);
    hand.click(tool, 51, 50, 5.2);
    hand.click(tool, 51, 50, 5.3);
    hand.click(tool, 90, 50, 5.4);
    CHECK(words(tool) == Words{"press", "release", "double", "release", "press", "release", "press", "release"});
}

TEST_CASE("a free-hand lasso becomes one command when the button is released") {
    Hand hand;
    LassoTool tool;
    const auto stroke = [&](Modifiers modifiers) {
        hand.mouse.press(Hand::tell(tool), hand.at(100, 100, modifiers), 1.0);
        for (int i = 1; i <= 100; ++i) hand.mouse.move(Hand::tell(tool), hand.at(100 + i, 100));
        for (int i = 1; i <= 100; ++i) hand.mouse.move(Hand::tell(tool), hand.at(200, 100 + i));
        CHECK(tool.drawing(hand.at(200, 200)).lines.at(0).points.size() > 100);
        hand.mouse.release(Hand::tell(tool), hand.at(200, 200));
        CHECK(tool.drawing(hand.at(200, 200)).lines.empty());
        return words(tool);
    };
    CHECK(stroke({}) == Words{"lasso", "100,100", "200,100", "200,200"});
    CHECK(stroke({.shift = true}) == Words{"lasso", "--add", "100,100", "200,100", "200,200"});
    hand.settings = {.lasso_any_part = true, .lasso_visible = true};
    CHECK(stroke({.ctrl = true}) == Words{"lasso", "--any", "--visible", "--remove", "100,100", "200,100", "200,200"});

    hand.click(tool, 10, 10, 3.0);
    CHECK(words(tool).empty()); // a click encloses nothing
    hand.mouse.press(Hand::tell(tool), hand.at(100, 100), 4.0);
    hand.mouse.move(Hand::tell(tool), hand.at(180, 180));
    CHECK(tool.escape()); // gives the stroke up,
    hand.mouse.move(Hand::tell(tool), hand.at(100, 180));
    hand.mouse.release(Hand::tell(tool), hand.at(100, 180));
    CHECK(words(tool).empty());
    CHECK_FALSE(tool.escape()); // then there is nothing left to give up
}

TEST_CASE("a polygon lasso closes by a double-click, a right click, or at its first corner") {
    Hand hand;
    PolygonLassoTool tool;
    double now = 0.0;
    const auto corners = [&] {
        hand.click(tool, 50, 50, now += 10.0, {.shift = true});
        hand.click(tool, 150.25, 50, now += 10.0);
        hand.click(tool, 150, 150, now += 10.0);
        CHECK(words(tool).empty());
        CHECK(tool.drawing(hand.at(70, 120)).lines.at(0).points.size() == 4); // and the way to the pointer
    };
    const Words expected{"lasso", "--add", "50,50", "150.3,50", "150,150"};
    corners();
    hand.click(tool, 54, 52, now += 10.0);
    CHECK(words(tool) == expected);
    corners();
    tool.right_click(hand.at(90, 90));
    CHECK(words(tool) == expected);
    corners();
    hand.click(tool, 150, 150, now + 0.1);
    CHECK(words(tool) == expected);
    hand.click(tool, 50, 50, now += 10.0);
    tool.right_click(hand.at(90, 90)); // one corner is no polygon
    CHECK(words(tool).empty());
    CHECK(tool.escape());
    CHECK(tool.drawing(hand.at(0, 0)).lines.empty());
}

TEST_CASE("every tool has an icon within its square, a label, a help text and a menu entry") {
    std::set<std::string> names;
    for (const ToolKind& kind : tool_kinds()) {
        CAPTURE(kind.name);
        CHECK(names.insert(kind.name).second);
        CHECK(kind.help.ends_with("."));
        CHECK_FALSE(kind.icon.empty());
        for (const auto& stroke : kind.icon)
            for (const glm::vec2& point : stroke) CHECK((point.x >= 0 && point.x <= 1 && point.y >= 0 && point.y <= 1));
        if (kind.make != nullptr) CHECK_FALSE(kind.make()->hint().empty());
        for (const std::string& key : kind.keys) {
            const Command* command = command_for_key(key);
            REQUIRE(bool(command));
            CHECK(command->preset == std::vector<std::string>{kind.name});
        }
    }
    CHECK(tool_kinds().front().name == kNavigate);
}
