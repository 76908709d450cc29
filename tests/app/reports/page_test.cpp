#include "app/actions/case_pages.h"
#include "app/reports/html.h"
#include "app/reports/page/branch_surface.h"
#include "app/reports/page/page_parts.h"
#include "app/reports/page/page_surface.h"
#include "app/reports/page/simplified_surface.h"
#include "core/io/trees/swc.h"
#include "core/measure/deviation/deviation.h"
#include "core/mesh/surface.h"
#include "tests/support/mesh_topology.h"

#include <algorithm>
#include <array>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

// A stem that forks twice.
constexpr const char* kForks =
    "1 0 0 0 0 1 -1\n2 0 0 0 10 1 1\n3 0 4 0 16 0.7 2\n4 0 -4 0 16 0.7 2\n5 0 6 0 22 0.5 3\n6 0 "
    "2 0 22 0.5 3\n";

struct PageForks {
    tree::VesselTree tree = *io::parse_tree(kForks, "forks.swc");
    tree::Dependency dependency{tree};
    mesh::TriangleMesh mesh = [this] {
        Job job;
        return mesh::make_surface(tree, {}, job)->mesh;
    }();
};

mesh::TriangleMesh mesh_of(const BranchSurface& surface) {
    mesh::TriangleMesh mesh;
    mesh.positions.assign(surface.positions.begin(), surface.positions.end());
    for (std::size_t i = 0; i < surface.indices.size(); i += 3)
        mesh.triangles.emplace_back(surface.indices[i], surface.indices[i + 1], surface.indices[i + 2]);
    return mesh;
}

// Simplifying leaves vertices that no triangle uses.
bool is_closed(const BranchSurface& surface) {
    test::Topology shape = test::topology(mesh_of(surface));
    shape.unused_vertices = 0;
    return shape.closed_manifold();
}
double volume_of(const BranchSurface& surface) { return measure::size_of(mesh_of(surface)).volume_mm3.value_or(0.0); }

} // namespace

TEST_CASE("a surface that is divided by branch is the same surface, and a subtree is one range") {
    const PageForks forks;
    const BranchSurface whole = undivided(forks.mesh), divided = divided_by_branch(forks.mesh, forks.dependency);
    CHECK(is_closed(divided));
    // New vertices are on edges: flat triangles are divided into flat parts.
    CHECK(volume_of(divided) == doctest::Approx(volume_of(whole)).epsilon(1e-5));
    REQUIRE(divided.first.size() == forks.tree.branches.size() + 1);
    CHECK(divided.first.back() == divided.triangles());
    CHECK(divided.triangles() > whole.triangles());
    for (std::size_t rank = 0; rank < forks.tree.branches.size(); ++rank) {
        CHECK(divided.first[rank] < divided.first[rank + 1]);
        const auto branch = static_cast<std::size_t>(forks.dependency.order()[rank]);
        double thinnest = 1e9;
        for (const std::uint32_t point : forks.tree.branches[branch].points)
            thinnest = std::min(thinnest, forks.tree.points[point].radius);
        CHECK(double(divided.radius_mm[rank]) == doctest::Approx(thinnest).epsilon(0.25)); // smoothing moves radii
    }
}

TEST_CASE("simplifying keeps a divided surface closed, and borders where they are") {
    const PageForks forks;
    const BranchSurface divided = divided_by_branch(forks.mesh, forks.dependency);
    const BranchSurface fewer = simplified(divided, {0.02, 1.0, false, 0.0});
    CHECK(is_closed(fewer));
    CHECK(fewer.triangles() < divided.triangles());
    CHECK(volume_of(fewer) == doctest::Approx(volume_of(divided)).epsilon(0.02));
    CHECK(fewer.first.size() == divided.first.size());
}

TEST_CASE("a page's surface is below its limit or refused") {
    const PageForks forks;
    Job job;
    const JobRange all(job, 0.0F, 1.0F);
    const auto usual = page_surface(forks.mesh, forks.dependency, {std::size_t{1} << 30, 0.02}, all);
    REQUIRE(usual);
    CHECK_FALSE(usual->for_size);
    CHECK(usual->packed.triangles >= usual->triangles_before); // small surfaces are shown whole
    CHECK(usual->largest_deviation_mm < 0.02);
    CHECK(usual->packed.widest_step_mm <= 0.02);
    const std::size_t bytes = usual->packed.bytes() * 4 / 3;
    const auto small = page_surface(forks.mesh, forks.dependency, {bytes / 2, 0.02}, all);
    REQUIRE(small);
    CHECK(small->for_size);
    CHECK(small->packed.triangles < small->triangles_before);
    CHECK(small->largest_deviation_mm > usual->largest_deviation_mm);
    CHECK(small->packed.bytes() * 4 / 3 <= bytes / 2);
    const auto refused = page_surface(forks.mesh, forks.dependency, {100, 0.02}, all);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().hint.find("--size-limit") != std::string::npos);
}

TEST_CASE("what is left out of a page is in no mark") {
    const PageForks forks;
    Marks marks;
    marks.names = {{0, "Mrs Example"}};
    marks.subtree_names = {0};
    Lesion lesion;
    lesion.sphere = {0.0, 0.0, 0.0, 1.0};
    lesion.name = "Mrs Example's";
    marks.lesions = {lesion};
    Resection around;
    around.kind = Resection::Kind::kLesion;
    Resection plane;
    plane.name = "Mrs Example's";
    marks.resections = {around, plane};
    marks.cuts = {{1, 0.5}};
    marks.plans.name = "Dr Example's";
    marks.plans.others = {{"Mrs Example's", {{0, 0.5}}, {plane}}};
    marks.views = {{"Mrs Example's", {.scale = 3.0}}};
    const Marks nameless = marks_without(marks, std::array{PagePart::kNames}, forks.tree);
    CHECK(nameless.names.empty());
    CHECK(nameless.subtree_names.empty());
    CHECK(nameless.lesions[0].name == "Lesion 1");
    CHECK(nameless.resections[1].name == "Resection 2");
    CHECK(nameless.plans.name == "Plan 1");
    CHECK(nameless.plans.others[0].name == "Plan 2");
    CHECK(nameless.plans.others[0].resections[0].name == "Resection 1");
    CHECK(nameless.views == std::vector<SavedView>{{"View 1", {.scale = 3.0}}});
    CHECK(marks_without(marks, std::array{PagePart::kViews}, forks.tree).views.empty());
    const Marks without_lesions = marks_without(marks, std::array{PagePart::kLesions}, forks.tree);
    CHECK(without_lesions.lesions.empty());
    CHECK(without_lesions.resections.size() == 1);
    const Marks without_plans = marks_without(marks, std::array{PagePart::kPlans}, forks.tree);
    CHECK((without_plans.cuts.empty() && without_plans.resections.empty() && without_plans.plans == Plans{}));
    CHECK(marks_without(marks, {}, forks.tree) == marks);
}

TEST_CASE("the options of a page are read, or refused with what is possible") {
    const std::vector<std::string> words{"--title",   "Board", "--size-limit", "2.5",
                                         "--without", "names", "--without",    "views"};
    const auto choice = actions::page_choice(words);
    REQUIRE(choice);
    CHECK(choice->title == "Board");
    CHECK(choice->most_bytes == 2'500'000);
    CHECK(choice->left_out == std::vector{PagePart::kNames, PagePart::kViews});
    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"--without", "blood"}, {"--size-limit", "0"}, {"--title"}, {"more"}}) {
        const auto refused = actions::page_choice(wrong);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().hint.find("--without PART") != std::string::npos);
    }
}

TEST_CASE("filling a page inserts text once, and JSON cannot end its element") {
    CHECK(filled("<a>{{one}}</a>{{two}}", {{"one", "{{two}}"}, {"two", "2"}}) == "<a>{{two}}</a>2");
    const std::string text = script_json({{"name", "</script><!--"}, {"broken", "\xFF"}});
    CHECK(text.find('<') == std::string::npos);
    const auto read = nlohmann::json::parse(text);
    CHECK(read["name"] == "</script><!--");
    CHECK(read["broken"] == "\xEF\xBF\xBD");
}
