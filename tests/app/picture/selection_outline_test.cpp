// The outline of what is selected is laid out where something about it changes, and is the same either way.
#include "app/picture/compose.h"
#include "core/io/trees/tree_file.h"
#include "tests/support/command_stage.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

TEST_CASE("the outline of the selection is computed again only when it changes, and agrees with the session") {
    const TemporaryFolder folder;
    test::CommandStage stage{
        io::read_tree(folder.write("fork.swc", "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n"))
            .value()};
    const auto outline = [&] { return stage.current_assets().outline; };
    CHECK_FALSE(outline()); // nothing is selected
    stage.good("select 1");
    const auto first = outline();
    REQUIRE(first);
    CHECK(first->marks.size() >= 2); // a line to either side
    const auto lines = [&](const Assets& assets) {
        return compose(stage.document.session(), assets, nullptr, {.hovered = 2}).lines;
    };
    const auto as_without = [&] {
        Assets without = stage.current_assets();
        without.outline.reset();
        return lines(without);
    };
    CHECK(lines(stage.current_assets()) == as_without());
    stage.good("colour-by diameter\nhighlight\nundo");
    CHECK(outline() == first);
    stage.good("turn left 30");
    const auto turned = outline();
    CHECK(turned != first);
    CHECK(turned->marks != first->marks);
    CHECK(lines(stage.current_assets()) == as_without());
    stage.good("select 1 2");
    CHECK(outline()->marks.size() > turned->marks.size());
    stage.good("hide");
    CHECK((!outline() || outline()->marks.empty()));
    // A picture of another session than the one that the assets are brought up to.
    stage.good("undo");
    Session other = stage.document.session();
    other.camera.position *= -1.0;
    CHECK(compose(other, stage.current_assets(), nullptr, {}).lines != lines(stage.current_assets()));
}
