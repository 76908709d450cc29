// Menus, cards and the dialog of quitting, with the mouse and without a window.
#include "app/actions/command_table.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/error_dialog.h"
#include "app/panels/help_overlay.h"
#include "app/panels/menu_bar.h"
#include "app/panels/warnings_panel.h"
#include "tests/support/viewer_stage.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <set>

using namespace ramus;
using test::ViewerStage;

namespace {

constexpr const char* kFork = "1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n3 1 -15 3 12 1.5 2\n4 1 14 -2 15 1.2 2\n";

void draw_frames(ViewerStage& stage, int frames = 4) {
    for (int i = 0; i < frames; ++i) stage.draw();
}

} // namespace

TEST_CASE("each menu opens at a click, stays open when the button is released, and chooses nothing" *
          doctest::test_suite("slow")) {
    std::set<std::string> menus;
    for (const app::Command& command : app::command_table())
        if (!command.menu.empty()) menus.insert(command.menu);
    for (const glm::ivec2 size : {glm::ivec2(1440, 900), glm::ivec2(1024, 700)}) {
        CAPTURE(size.x);
        ViewerStage stage(kFork, size);
        stage.settle();
        const app::Interface& interface = stage.viewer->interface();
        std::set<std::string> opened;
        const double y = 0.5 * stage.viewer->layout().bar_height;
        for (double x = 12.0; x < 640.0; x += 12.0) {
            stage.viewer->input().mouse_moved({x, y});
            stage.button(true, 0.5);
            draw_frames(stage);
            const std::string pressed = interface.of<app::BarMenus>().open_name;
            stage.button(false, 0.1);
            draw_frames(stage);
            CHECK(interface.of<app::BarMenus>().open_name == pressed);
            if (!pressed.empty()) opened.insert(pressed);
            CHECK_FALSE((interface.left_is<app::Doctor>() || interface.dialog_open() ||
                         interface.left_is<app::WarningsPanel>()));
            // Away from the bar a click closes it.
            stage.viewer->input().mouse_moved({700.0, 500.0});
            stage.button(true, 0.5);
            stage.button(false, 0.1);
            draw_frames(stage);
            REQUIRE(interface.of<app::BarMenus>().open_name.empty());
        }
        CHECK(opened == menus);
    }
}

TEST_CASE("arrows lead through menus that a click has opened, and the view stays" * doctest::test_suite("slow")) {
    ViewerStage stage(kFork, {1440, 900});
    stage.settle();
    const app::Interface& interface = stage.viewer->interface();
    const render::Camera before = stage.workspace.document().session().camera;
    stage.viewer->input().mouse_moved({25.0, 0.5 * stage.viewer->layout().bar_height});
    stage.button(true, 0.5);
    stage.button(false, 0.1);
    draw_frames(stage);
    REQUIRE(interface.of<app::BarMenus>().open_name == "File");
    const auto press = [&](const char* name) {
        stage.viewer->input().key(0, true, app::KeyPress{name}, {}, stage.now);
        draw_frames(stage);
    };
    press("Right");
    CHECK(interface.of<app::BarMenus>().open_name == "Edit");
    press("Left");
    press("Left");
    CHECK(interface.of<app::BarMenus>().open_name == "Help");
    press("Down");
    CHECK(stage.workspace.document().session().camera == before);
}

TEST_CASE("the card about a branch leaves the tools, the scale bar, the cube and the status line free") {
    const glm::vec2 card(250.0F, 150.0F);
    for (const glm::ivec2 size : {glm::ivec2(1440, 900), glm::ivec2(1024, 700)}) {
        const app::Layout layout = app::layout_of(size, 1.0F, true);
        const glm::vec2 from(layout.view_at), to = from + glm::vec2(layout.view_size);
        for (int i = 0; i <= 20; ++i)
            for (int k = 0; k <= 12; ++k) {
                const glm::vec2 share(static_cast<float>(i) / 20.0F, static_cast<float>(k) / 12.0F);
                // Below the tools, which take the pointer themselves.
                const glm::vec2 pointer = from + glm::vec2(4.0F, 54.0F) + share * (to - from - glm::vec2(8.0F, 58.0F));
                const glm::vec2 corner = app::card_corner(layout, {}, pointer, card, 1.0F), end = corner + card;
                CAPTURE(pointer.x);
                CAPTURE(pointer.y);
                CHECK(corner.y >= from.y + 50.0F);
                CHECK(end.y <= to.y);
                CHECK(end.x <= to.x);
                CHECK_FALSE((end.x > to.x - 100.0F && end.y > to.y - 100.0F));
                CHECK_FALSE((corner.x < from.x + 150.0F && end.y > to.y - 60.0F));
                CHECK_FALSE((corner.x < pointer.x && pointer.x < end.x && corner.y < pointer.y && pointer.y < end.y));
                // And a panel over the picture's left edge, which takes the pointer itself.
                const app::Covered panel{from + glm::vec2(10.0F, 56.0F), {from.x + 310.0F, to.y - 68.0F}};
                if (pointer.x < panel.to.x && pointer.y < panel.to.y) continue;
                const glm::vec2 right = app::card_corner(layout, {panel}, pointer, card, 1.0F);
                CHECK((right.x >= panel.to.x || right.y >= panel.to.y));
            }
    }
}

TEST_CASE("of two dialogs that are open one is shown, and then the other" * doctest::test_suite("slow")) {
    ViewerStage stage(kFork, {1440, 900});
    stage.settle();
    stage.viewer->note_controls();
    const auto shown = [&](const char* control) {
        draw_frames(stage);
        return stage.viewer->controls()->contains(control);
    };
    const auto press = [&](const char* name) {
        stage.viewer->input().key(0, true, app::KeyPress{name}, {}, stage.now);
    };
    press("F1");
    CHECK(shown("dialog help"));
    stage.workspace.open(stage.folder.path() / "missing.swc");
    stage.settle();
    REQUIRE_FALSE(stage.viewer->interface().of<app::ErrorDialog>().errors.empty());
    CHECK(shown("dialog error"));
    CHECK_FALSE(shown("dialog help"));
    press("Escape");
    CHECK(shown("dialog help"));
}

TEST_CASE("the title marks work that is not saved, and no other view of it" * doctest::test_suite("slow")) {
    ViewerStage stage(kFork, {1024, 700});
    stage.settle();
    CHECK_FALSE(stage.viewer->title().starts_with("*"));
    app::Marks marks = stage.workspace.document().marks();
    marks.colour_by = app::ColourBy::kSystem;
    marks.selection = {1};
    stage.workspace.document().change(marks);
    CHECK_FALSE(stage.viewer->title().starts_with("*"));
    marks.lesions = {{.sphere = {0.0, 0.0, 0.0, 5.0}}};
    stage.workspace.document().change(marks);
    CHECK(stage.viewer->title().starts_with("*"));
}
