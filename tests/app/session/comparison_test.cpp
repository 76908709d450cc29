// Surfaces of the same vessels looked at together: what is said, kept and undone, where viewports lie, what they show,
// and how the surfaces come to be.
#include "app/picture/compose_sheet.h"
#include "app/session/session_file.h"
#include "app/session/systems.h"
#include "app/workspace/workspace.h"
#include "core/tree/build_tree.h"
#include "tests/support/command_stage.h"
#include "tests/support/nifti_file.h"
#include "tests/support/settle.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/two_systems.h"

#include <doctest/doctest.h>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;
using ramus::test::settle;
using Mode = Comparison::Mode;

namespace {

// A stem of 20 mm along z that forks in two.
tree::VesselTree forked() {
    tree::Graph graph;
    graph.points = {{{0, 0, 0}, 2.0}, {{0, 0, 20}, 2.0}, {{10, 0, 30}, 1.0}, {{-10, 0, 30}, 1.5}};
    graph.edges = {{0, 1}, {1, 2}, {1, 3}};
    graph.roots = {0};
    auto tree = tree::build_tree(std::move(graph), tree::Repair::kAll, [](std::uint32_t) { return std::string(); });
    REQUIRE(tree);
    return std::move(*tree);
}

// A box of 4 x 4 x 20 mm around its stem, of label 3, at `x` mm.
std::filesystem::path write_mask(const std::filesystem::path& path, double x = 0.0) {
    test::NiftiFile file;
    file.dim = {3, 8, 8, 24, 1, 1, 1, 1};
    file.rows = {1, 0, 0, x - 3.5, 0, 1, 0, -3.5, 0, 0, 1, -1.5};
    std::vector<std::uint8_t> voxels;
    for (int k = 0; k < 24; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 8; ++i)
                voxels.push_back(i >= 2 && i < 6 && j >= 2 && j < 6 && k >= 2 && k < 22 ? 3 : 0);
    file.put(voxels);
    std::ofstream(path, std::ios::binary) << file.bytes();
    return path;
}

} // namespace

TEST_CASE("a comparison and the skeleton are saved in sessions, and only there if they are used") {
    const TemporaryFolder folder;
    Session session;
    session.tree.path = folder.path() / "tree.swc";
    CHECK_FALSE(to_json(session, folder.path()).contains("comparison"));
    session.marks.skeleton = true;
    session.marks.comparison = {Mode::kBlend,
                                {Compared::kIsosurface, Compared::kTruncatedCones, Compared::kConvolutionSurface},
                                (folder.path() / "masks" / "liver.nii.gz").string(),
                                "",
                                {-1, 2},
                                1.0 / 3.0};
    const auto file = folder.path() / "session.ramus.json";
    REQUIRE(write_session(session, file));
    const auto read = read_session(file);
    REQUIRE_MESSAGE(read, read.error().message());
    CHECK(read->session == session);
    CHECK(to_json(session, folder.path())["comparison"]["mask"] == "masks/liver.nii.gz");

    const auto refused = [&](const nlohmann::json& comparison) {
        auto value = to_json(session, folder.path());
        value["comparison"] = comparison;
        return !session_from_json(value, folder.path(), "s.json");
    };
    CHECK_FALSE(refused({{"mode", "off"}}));
    CHECK(refused({{"mode", "upside-down"}}));
    CHECK(refused({{"surfaces", {"cs"}}}));
    CHECK(refused({{"surfaces", {"cs", "cs"}}}));
    CHECK(refused({{"surfaces", {"cs", "magic"}}}));
    CHECK(refused({{"labels", {0}}}));
    CHECK(refused({{"labels", {1.5}}}));
    CHECK(refused({{"blend", 1.1}}));
    CHECK(refused({{"wipe", -0.1}}));
    CHECK_FALSE(to_json(session, folder.path())["comparison"].contains("wipe"));
    session.marks.comparison.mode = Mode::kWipe;
    session.marks.comparison.surfaces = {Compared::kMerged, Compared::kApart};
    session.marks.comparison.wipe = 0.25;
    const auto wiped = session_from_json(to_json(session, folder.path()), folder.path(), "s.json");
    REQUIRE(wiped);
    CHECK(wiped->session == session);
    CHECK(refused({{"colour", "red"}}));
    CHECK(refused(3));
}

TEST_CASE("commands of comparisons can be undone, and refuse invalid arguments") {
    const TemporaryFolder folder;
    const auto mask = write_mask(folder.path() / "mask of it.nii");
    test::CommandStage stage(forked());
    const Marks start = stage.marks();
    stage.good("compare side-by-side iso,cones,cs");
    CHECK(stage.marks().comparison.mode == Mode::kSideBySide);
    CHECK(stage.marks().comparison.surfaces ==
          std::vector{Compared::kIsosurface, Compared::kTruncatedCones, Compared::kConvolutionSurface});
    stage.good("compare blend");
    CHECK(stage.marks().comparison.surfaces.size() == 3);
    CHECK(compared_surfaces(stage.marks().comparison) == std::vector{Compared::kIsosurface, Compared::kTruncatedCones});
    stage.good("compare-blend 0.25");
    CHECK(stage.marks().comparison.blend == 0.25);
    stage.good("compare-mask \"" + mask.string() + "\" 3,1,3");
    CHECK(stage.marks().comparison.mask == mask.string());
    CHECK(stage.marks().comparison.labels == std::vector<volume::LabelChoice>{1, 3});
    CHECK(title_of(Compared::kIsosurface, stage.marks().comparison) == "Isosurface of mask of it.nii, labels 1, 3");
    // The voxels of a file stay when branches are hidden, and the picture says so.
    Marks hides = stage.marks();
    hides.states = {tree::BranchState::kHidden};
    stage.document.change(hides);
    CHECK(viewports_of(Session{{}, stage.marks(), {}, {}}, {800, 400}, 1.0F).front().title ==
          "Isosurface of mask of it.nii, labels 1, 3, with what is hidden");
    stage.good("skeleton");
    CHECK(stage.marks().skeleton);
    stage.good("skeleton off");
    CHECK_FALSE(stage.marks().skeleton);
    stage.good("compare-mask none");
    CHECK(stage.marks().comparison.mask.empty());
    CHECK(stage.marks().comparison.labels.empty());
    for (const char* wrong :
         {"compare", "compare beside", "compare blend cs", "compare blend cs,cs", "compare blend cs, iso",
          "compare side-by-side cs,cones,iso,cs", "compare-blend", "compare-blend 1.01", "compare-blend nan",
          "compare-mask absent.nii", "compare-mask a b c", "skeleton perhaps"})
        stage.bad(wrong);
    stage.bad("compare-mask \"" + mask.string() + "\" 0");
    while (stage.document.undo()) {
    }
    CHECK(stage.marks() == start);
    while (stage.document.redo()) {
    }
    CHECK(stage.marks().comparison.blend == 0.25);
}

TEST_CASE("viewports have one size, lie inside the picture in their order, and do not touch") {
    Marks marks;
    CHECK(viewports_of(Session{{}, marks, {}, {}}, {800, 600}, 1.0F) ==
          std::vector<Viewport>{{{0, 0}, {800, 600}, Compared::kConvolutionSurface, "", true}});
    marks.options.method = mesh::Method::kTruncatedCones;
    CHECK(viewports_of(Session{{}, marks, {}, {}}, {800, 600}, 1.0F)[0].surface == Compared::kTruncatedCones);
    marks.comparison.mode = Mode::kSideBySide;
    for (const std::size_t count : {2U, 3U}) {
        marks.comparison.surfaces = {Compared::kIsosurface, Compared::kTruncatedCones, Compared::kConvolutionSurface};
        marks.comparison.surfaces.resize(count);
        for (const glm::ivec2 size : {glm::ivec2{800, 600}, {801, 600}, {802, 600}, {333, 1000}, {100, 100}, {7, 2}})
            for (const float ratio : {1.0F, 1.5F, 2.0F}) {
                CAPTURE(count);
                CAPTURE(size.x);
                CAPTURE(ratio);
                const auto viewports = viewports_of(Session{{}, marks, {}, {}}, size, ratio);
                REQUIRE(viewports.size() == count);
                const int along = size.x >= size.y ? 0 : 1, line = ratio > 1.4F ? 2 : 1;
                CHECK(viewports.front().at == glm::ivec2(0));
                CHECK(viewports.back().at[along] + viewports.back().size[along] == size[along]);
                for (std::size_t i = 0; i < count; ++i) {
                    CHECK(viewports[i].size == viewports[0].size);
                    CHECK(viewports[i].size[1 - along] == size[1 - along]);
                    CHECK(viewports[i].surface == marks.comparison.surfaces[i]);
                    CHECK(viewports[i].has_branches == (viewports[i].surface != Compared::kIsosurface));
                    CHECK_FALSE(viewports[i].title.empty());
                    if (i == 0 || size.x < 10) continue;
                    const int gap = viewports[i].at[along] - viewports[i - 1].at[along] - viewports[i - 1].size[along];
                    CHECK(gap >= line);
                    CHECK(gap <= line + 2); // and what does not divide
                }
            }
    }
    for (const Mode mode : {Mode::kBlend, Mode::kSuperimposed, Mode::kWipe}) {
        marks.comparison.mode = mode;
        const auto viewports = viewports_of(Session{{}, marks, {}, {}}, {800, 600}, 1.0F);
        CHECK(viewports.size() == (mode == Mode::kSuperimposed ? 1U : 2U));
        for (const Viewport& viewport : viewports) {
            CHECK(viewport.at == glm::ivec2(0));
            CHECK(viewport.size == glm::ivec2(800, 600));
        }
    }
}

TEST_CASE("all viewports have one camera; one without branches shows nothing of them") {
    test::CommandStage stage(forked());
    ShownSurfaces surfaces;
    for (auto& mesh : surfaces.meshes) mesh = std::make_shared<const render::PagedMesh>();
    surfaces.lines = std::make_shared<const mesh::TriangleMesh>();
    stage.good("select 1\nhide\nselect 2\ncolour-by diameter\ncut 2\nskeleton on\ncompare side-by-side iso,cones,cs");
    const Viewing viewing{.size = {900, 300}, .hovered = 2};
    const render::Sheet sheet = compose_sheet(stage.document.session(), stage.current_assets(), surfaces, viewing);
    REQUIRE(sheet.viewports.size() == 3);
    CHECK_FALSE(sheet.blend);
    int bars = 0, cubes = 0, legends = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const render::Frame& frame = sheet.viewports[i].frame;
        const bool iso = i == 0;
        CHECK(frame.camera == stage.document.session().camera);
        CHECK(frame.size == sheet.viewports[0].frame.size);
        const bool cones = stage.marks().comparison.surfaces[i] == Compared::kTruncatedCones; // so they move
        CHECK((frame.width == 0.0F) == cones);
        CHECK((frame.beyond_ends == 1.0F) == cones);
        CHECK(frame.mesh == surfaces.of(stage.marks().comparison.surfaces[i]));
        CHECK(sheet.viewports[i].has_branches == !iso);
        CHECK(frame.states.empty() == iso);
        CHECK(frame.selected.empty() == iso);
        CHECK(frame.lost.empty() == iso);
        CHECK(frame.hovered == (iso ? render::kNoBranch : 2));
        CHECK((frame.centerlines == nullptr) == iso); // else it would be cones while it moves
        CHECK(frame.skeleton != nullptr);
        CHECK_FALSE(frame.overlays.heading.empty());
        bars += frame.overlays.scale_bar ? 1 : 0;
        cubes += frame.overlays.orientation_cube ? 1 : 0;
        legends += frame.overlays.legend.title.empty() ? 0 : 1;
    }
    CHECK(bars == 1);
    CHECK(cubes == 1);
    CHECK(legends == 1);

    stage.good("compare blend cs,iso\ncompare-blend 0.25");
    const render::Sheet blend = compose_sheet(stage.document.session(), stage.current_assets(), surfaces, viewing);
    CHECK(blend.blend == 0.25);
    CHECK(blend.heading == "Convolution surface 75 %, isosurface of the tree's voxels 25 %");
    CHECK(blend.viewports[0].frame.overlays == blend.viewports[1].frame.overlays); // what lies over both is not faded
    // Fading changes no frame.
    const render::Sheet tried =
        compose_sheet(stage.document.session(), stage.current_assets(), surfaces, viewing, {.blend = 0.75});
    CHECK(tried.viewports == blend.viewports);
    CHECK(tried.blend == 0.75);

    stage.good("compare wipe iso,cs\ncompare-wipe 0.25");
    const render::Sheet wiped = compose_sheet(stage.document.session(), stage.current_assets(), surfaces, viewing);
    CHECK_FALSE(wiped.blend);
    CHECK(wiped.wipe == 0.25);
    CHECK(wiped.heading == "Isosurface of the tree's voxels left, convolution surface right");
    CHECK(wiped.viewports[0].frame.overlays == wiped.viewports[1].frame.overlays);
    const render::Sheet dragged =
        compose_sheet(stage.document.session(), stage.current_assets(), surfaces, viewing, {.wipe = 0.75});
    CHECK(dragged.viewports == wiped.viewports);
    CHECK(dragged.wipe == 0.75);

    stage.good("compare superimposed");
    const render::Sheet over = compose_sheet(stage.document.session(), stage.current_assets(), surfaces, viewing);
    REQUIRE(over.viewports.size() == 1);
    REQUIRE(over.viewports[0].frame.context.size() == 1);
    CHECK(over.viewports[0].frame.context[0].wireframe);
    CHECK(over.viewports[0].frame.context[0].mesh == surfaces.lines);

    stage.good("compare off");
    const render::Sheet plain = compose_sheet(stage.document.session(), stage.current_assets(), surfaces, viewing);
    REQUIRE(plain.viewports.size() == 1);
    CHECK(plain.viewports[0].frame == compose(stage.document.session(), stage.current_assets(),
                                              surfaces.of(Compared::kConvolutionSurface), viewing));
}

TEST_CASE("an isosurface next to vessel systems has a colour of its own") {
    test::CommandStage stage(test::two_systems());
    ShownSurfaces surfaces;
    for (auto& mesh : surfaces.meshes) mesh = std::make_shared<const render::PagedMesh>();
    stage.good("colour-by system\ncompare side-by-side cs,iso");
    const auto sheet = compose_sheet(stage.document.session(), stage.current_assets(), surfaces, {.size = {900, 300}});
    const render::Appearance usual;
    CHECK(sheet.viewports[0].frame.appearance.vessel == usual.vessel);
    const glm::vec3 neutral = sheet.viewports[1].frame.appearance.vessel;
    const Systems nameless(8);
    for (int system = 0; system < 8; ++system)
        CHECK(glm::distance(neutral, shown_colour(nameless, system)) > 0.25F); // sRGB, of 1.73 from black to white
    // A grey: no hue that could be one of theirs.
    CHECK(std::max({neutral.x, neutral.y, neutral.z}) - std::min({neutral.x, neutral.y, neutral.z}) < 0.1F);

    test::CommandStage plain(forked());
    plain.good("compare side-by-side cs,iso");
    const auto alike = compose_sheet(plain.document.session(), plain.current_assets(), surfaces, {.size = {900, 300}});
    CHECK(alike.viewports[1].frame.appearance.vessel == usual.vessel);
}

TEST_CASE("a comparison requests the surfaces that it needs") {
    Marks marks;
    CHECK(compared_requests(marks).empty());
    marks.comparison = {
        Mode::kSideBySide, {Compared::kConvolutionSurface, Compared::kIsosurface}, "mask.nii", "", {3}, 0.5};
    auto requests = compared_requests(marks);
    REQUIRE(requests.size() == 1); // its own is there
    CHECK(requests[0].kind == Compared::kIsosurface);
    CHECK(requests[0].mask == "mask.nii");
    CHECK(requests[0].labels == std::vector<volume::LabelChoice>{3});
    // Hiding and smoothing are nothing to a mask.
    set_state(marks, std::vector<int>{1}, tree::BranchState::kHidden);
    marks.options.smooth_passes = 4;
    CHECK(compared_requests(marks) == requests);
    marks.options.method = mesh::Method::kTruncatedCones;
    requests = compared_requests(marks);
    REQUIRE(requests.size() == 2);
    CHECK(requests[0].kind == Compared::kConvolutionSurface);
    CHECK(requests[0].surface.hidden == std::vector<int>{1});
    marks.comparison.mode = Mode::kSuperimposed;
    marks.comparison.surfaces = {Compared::kConvolutionSurface, Compared::kTruncatedCones};
    requests = compared_requests(marks);
    REQUIRE(requests.size() == 2); // its own, as lines
    CHECK_FALSE(requests[0].wire);
    CHECK(requests[1].wire);
}

TEST_CASE("both blends can be compared, whichever the session uses") {
    Marks marks;
    marks.comparison.mode = Mode::kWipe;
    marks.comparison.surfaces = {Compared::kMerged, Compared::kApart};
    const auto mesh = std::make_shared<const render::PagedMesh>();
    for (const mesh::Blend blend : {mesh::Blend::kTree, mesh::Blend::kPaper}) {
        marks.options.blend = blend;
        const Compared own = blend == mesh::Blend::kTree ? Compared::kApart : Compared::kMerged;
        const Compared other = blend == mesh::Blend::kTree ? Compared::kMerged : Compared::kApart;
        const auto requests = compared_requests(marks);
        REQUIRE(requests.size() == 1);
        CHECK(requests[0].kind == other);
        CHECK(requests[0].surface.options.blend != blend);
        CHECK(requests[0].surface.options.method == mesh::Method::kConvolutionSurface);
        ShownSurfaces surfaces;
        surfaces.set_own(marks.options, mesh, nullptr);
        CHECK(surfaces.of(own) == mesh);
        CHECK(surfaces.of(Compared::kConvolutionSurface) == mesh);
        CHECK_FALSE(surfaces.of(other));
        CHECK_FALSE(surfaces.of(Compared::kTruncatedCones));
    }
    marks.options.method = mesh::Method::kTruncatedCones;
    CHECK(compared_requests(marks).size() == 2);
}

TEST_CASE("surfaces for a comparison are computed with and without a mask") {
    const TemporaryFolder folder;
    const tree::VesselTree tree = forked();
    Marks marks;
    marks.comparison.mask = write_mask(folder.path() / "mask.nii").string();
    Job job;
    const auto iso = make_compared(tree, compared_request(marks, Compared::kIsosurface), job);
    REQUIRE_MESSAGE(iso, iso.error().message());
    // A box of voxels whose centres span 3 x 3 x 19 mm, the surface half a voxel farther.
    const render::Box& box = iso->mesh->bounds();
    CHECK(glm::distance(box.lower, glm::dvec3(-2.0, -2.0, 0.0)) < 1e-5);
    CHECK(glm::distance(box.upper, glm::dvec3(2.0, 2.0, 20.0)) < 1e-5);
    CHECK(iso->mesh->branch_count() == 1);
    CHECK(iso->voxel_mm == 0.0);

    marks.comparison.labels = {1};
    const auto absent = make_compared(tree, compared_request(marks, Compared::kIsosurface), job);
    REQUIRE_FALSE(absent);
    CHECK(absent.error().message().find("mask.nii") != std::string::npos);
    marks.comparison.labels = {3};
    marks.comparison.mask = write_mask(folder.path() / "elsewhere.nii", 500.0).string();
    const auto elsewhere = make_compared(tree, compared_request(marks, Compared::kIsosurface), job);
    REQUIRE_FALSE(elsewhere);
    CHECK(elsewhere.error().message().find("elsewhere") != std::string::npos);

    marks.comparison.mask.clear();
    const auto own = make_compared(tree, compared_request(marks, Compared::kIsosurface), job);
    REQUIRE_MESSAGE(own, own.error().message());
    CHECK(own->voxel_mm > 0.0);
    CHECK(own->mesh->triangle_count() > 100);
    // Hidden branches are in none of the pictures.
    set_state(marks, std::vector<int>{1}, tree::BranchState::kHidden);
    const auto fewer = make_compared(tree, compared_request(marks, Compared::kIsosurface), job);
    REQUIRE(fewer);
    CHECK(fewer->mesh->triangle_count() < own->mesh->triangle_count());
    CHECK(fewer->voxel_mm == own->voxel_mm);
    set_state(marks, std::vector<int>{0, 1, 2}, tree::BranchState::kHidden);
    const auto empty = make_compared(tree, compared_request(marks, Compared::kIsosurface), job);
    REQUIRE(empty);
    CHECK(empty->mesh->triangle_count() == 0);
    marks.states.clear();
    ComparedRequest wire = compared_request(marks, Compared::kTruncatedCones);
    wire.wire = true;
    const auto lines = make_compared(tree, wire, job);
    REQUIRE(lines);
    CHECK_FALSE(lines->mesh);
    CHECK(lines->lines->triangles.size() > 100);
    wire.surface.hidden = {0, 1, 2};
    const auto nothing = make_compared(tree, wire, job);
    REQUIRE(nothing);
    CHECK(nothing->lines->triangles.empty());
}

TEST_CASE("a workspace computes the surfaces of a comparison in the background, and reports failures") {
    const TemporaryFolder folder;
    Workspace workspace({});
    const auto file = folder.path() / "fork.swc";
    std::ofstream(file) << "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n";
    workspace.open(file);
    REQUIRE(settle(workspace, [&] { return workspace.surface_ready(); }));
    CHECK_FALSE(workspace.awaited(WorkKind::kComparison));
    const auto change = [&](const auto& how) {
        Marks next = workspace.document().marks();
        how(next);
        workspace.document().change(next);
    };
    change([](Marks& m) {
        m.comparison.mode = Mode::kSideBySide;
        m.comparison.surfaces = {Compared::kIsosurface, Compared::kTruncatedCones, Compared::kConvolutionSurface};
    });
    CHECK(workspace.awaited(WorkKind::kComparison));
    REQUIRE(settle(workspace, [&] { return !workspace.awaited(WorkKind::kComparison); }));
    CHECK(workspace.problem(WorkKind::kComparison).empty());
    CHECK(workspace.surfaces().of(Compared::kConvolutionSurface) == workspace.shown().mesh);
    const auto whole = workspace.surfaces().of(Compared::kIsosurface);
    const auto cones = workspace.surfaces().of(Compared::kTruncatedCones);
    REQUIRE(whole);
    REQUIRE(cones);

    // The cones and the isosurface of the tree's own voxels follow what is hidden.
    change([](Marks& m) { set_state(m, std::vector<int>{2}, tree::BranchState::kHidden); });
    CHECK(workspace.surfaces().of(Compared::kTruncatedCones) == cones); // until the others are there
    REQUIRE(settle(workspace, [&] { return !workspace.busy() && !workspace.awaited(WorkKind::kComparison); }));
    CHECK(workspace.surfaces().of(Compared::kTruncatedCones) != cones);
    const auto iso = workspace.surfaces().of(Compared::kIsosurface);
    REQUIRE(iso);
    CHECK(iso != whole);

    std::ofstream(folder.path() / "bad.nii") << "this is no mask";
    change([&](Marks& m) { m.comparison.mask = (folder.path() / "bad.nii").string(); });
    REQUIRE(settle(workspace, [&] { return !workspace.awaited(WorkKind::kComparison); }));
    CHECK(workspace.problem(WorkKind::kComparison).find("bad.nii") != std::string::npos);
    CHECK(workspace.surfaces().of(Compared::kIsosurface) == iso); // what was there before
    change([&](Marks& m) { m.comparison.mask = write_mask(folder.path() / "mask.nii").string(); });
    REQUIRE(settle(workspace, [&] { return !workspace.awaited(WorkKind::kComparison); }));
    CHECK(workspace.problem(WorkKind::kComparison).empty());
    const auto masked = workspace.surfaces().of(Compared::kIsosurface);
    CHECK(masked != iso);
    // That of a mask's file knows no branches.
    change([](Marks& m) { set_state(m, std::vector<int>{2}, tree::BranchState::kNormal); });
    REQUIRE(settle(workspace, [&] { return !workspace.busy() && !workspace.awaited(WorkKind::kComparison); }));
    CHECK(workspace.surfaces().of(Compared::kIsosurface) == masked);

    change([](Marks& m) { m.comparison.mode = Mode::kOff; });
    workspace.update();
    CHECK_FALSE(workspace.surfaces().of(Compared::kIsosurface)); // nobody looks at it
}
