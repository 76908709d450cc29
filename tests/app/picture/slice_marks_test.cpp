// Measurements and pins on slices.
#include "app/picture/slice_marks.h"
#include "app/picture/slices.h"
#include "tests/support/built_tree.h"
#include "tests/support/command_stage.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

struct MarkStage : test::CommandStage {
    MarkStage() : CommandStage(test::built_tree({{{20, 15, 5}, 2.0}, {{20, 15, 45}, 2.0}}, {{0, 1}})) {}
    render::SliceView axial(double height) {
        good("slice axial " + std::to_string(height));
        refresh(assets, document);
        Viewing viewing;
        viewing.size = {300, 300};
        return compose_slice(document.session(), assets, slice::Direction::kAxial, viewing);
    }
};

} // namespace

TEST_CASE("a measurement is full on its slice, faint where it leaves it, and not on others") {
    MarkStage stage;
    stage.good("measure distance 10,15,20 30,15,20\nmeasure distance 12,15,22 12,15,32");
    const render::SliceView there = stage.axial(20.0);
    REQUIRE(there.labels.size() == 1);
    CHECK(there.labels[0].text == "20.0 mm");
    REQUIRE_FALSE(there.marks.empty());
    float most = 0.0F;
    for (const render::SliceMark& mark : there.marks) most = std::max(most, mark.opacity);
    CHECK(most == 1.0F);
    CHECK(stage.axial(21.0).marks.empty()); // without a scan slices are 1 mm apart
    CHECK(stage.axial(21.0).labels.empty());
    // A line across the slice: a part of it is full.
    const render::SliceView across = stage.axial(27.0);
    CHECK(across.labels.size() == 1);
    bool full = false;
    for (const render::SliceMark& mark : across.marks) {
        const double extent = std::abs(mark.points.front().z - mark.points.back().z);
        if (mark.opacity < 1.0F) continue;
        full = true;
        CHECK(extent == doctest::Approx(1.0));
    }
    CHECK(full);
    // In a slab more is on the slice; what is hidden or drawn by a tool is not.
    stage.good("slab 6 maximum");
    CHECK_FALSE(stage.axial(22.0).marks.empty());
    CHECK(stage.axial(22.0).labels.size() == 2);
    stage.good("object-hide measurement 1");
    CHECK(stage.axial(22.0).labels.size() == 1);
}

TEST_CASE("a pin is on its slice, with its text") {
    MarkStage stage;
    stage.good("pin 12,15,20 biopsy\npin 12,15,30 other");
    const render::SliceView there = stage.axial(20.0);
    REQUIRE(there.labels.size() == 1);
    CHECK(there.labels[0].text == "biopsy");
    CHECK(there.marks.size() == 4); // a ring and a dot, each faint and full
    CHECK(stage.axial(25.0).marks.empty());
}
