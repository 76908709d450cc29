// The import doctor's commands: going to what it found, and reading the file again.
#include "app/session/session_file.h"
#include "app/storage/opening_files.h"
#include "core/io/trees/tree_file.h"
#include "tests/support/command_stage.h"
#include "tests/support/nifti_file.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

// Vessels of an adult, in cm: a trunk that forks, with a radius of 0.
constexpr const char* kInCentimetres =
    "1 0 0 0 0 0.5 -1\n2 0 0 0 4 0 1\n3 0 0 0 8 0.4 2\n4 0 3 0 12 0.3 3\n5 0 -3 0 12 0.3 3\n";

struct Opened {
    TemporaryFolder folder;
    std::unique_ptr<test::CommandStage> stage;
    explicit Opened(const std::string& swc) {
        const auto path = folder.path() / "t.swc";
        std::ofstream(path) << swc;
        auto tree = io::read_tree(path);
        REQUIRE(tree);
        Session session;
        session.tree = {path, *checksum_of(path)};
        stage = std::make_unique<test::CommandStage>(std::move(*tree), std::move(session));
    }
    test::CommandStage* operator->() const { return stage.get(); }
    [[nodiscard]] const tree::VesselTree& tree() const { return *stage->document.tree(); }
};

} // namespace

TEST_CASE("read-as reads the file in another unit: radii are corrected, and marks and view are kept") {
    const Opened opened(kInCentimetres);
    opened->good("select 1\nhide\nselect 2");
    const Marks before = opened->marks();
    const render::Camera camera = opened->document.session().camera;
    CHECK(opened.tree().points.front().radius == 0.5);
    const auto first = opened->document.tree();
    const std::string said = opened->good("read-as units cm");
    CHECK(opened.tree().points.front().radius == 5.0);
    CHECK(said.find("10.0 mm wide") != std::string::npos);
    CHECK(opened->selection() == test::Ids{2});
    CHECK(opened->in(tree::BranchState::kHidden) == test::Ids{1});
    CHECK(opened->last_step() == "read as units cm");
    CHECK(opened->document.session().camera.scale == doctest::Approx(10.0 * camera.scale));
    CHECK(opened->current_assets().tree == opened->document.tree());
    CHECK(opened->document.facts()->statistics.radius_mm.max == 5.0);

    const auto second = opened->document.tree();
    REQUIRE(opened->document.undo());
    CHECK(opened->document.tree() == first);
    CHECK(opened->marks() == before);
    CHECK(opened->document.session().camera == camera);
    CHECK(opened->current_assets().tree == first);
    REQUIRE(opened->document.redo());
    CHECK(opened->document.tree() == second);
    CHECK(opened->marks().reading.unit == io::length_unit("cm"));
    // Whoever has turned the view since keeps it, as large as the tree is now.
    render::Camera turned = opened->document.session().camera;
    turned.position.x += 400.0;
    opened->document.set_camera(turned);
    REQUIRE(opened->document.undo());
    CHECK(opened->document.session().camera.scale == doctest::Approx(camera.scale));
    const auto distance = [](const render::Camera& c) { return glm::distance(c.position, c.focal_point); };
    CHECK(distance(opened->document.session().camera) == doctest::Approx(0.1 * distance(turned)));
}

TEST_CASE("read-as accepts several options, removes them again, and refuses invalid ones") {
    const Opened opened(kInCentimetres);
    opened->good("read-as units cm radius-is diameter axes lps");
    CHECK(opened.tree().points.front().radius == 2.5);
    CHECK(opened->marks().reading.orientation == io::Orientation::lps());
    opened->good("read-as radius-is auto");
    CHECK(opened.tree().points.front().radius == 5.0);
    opened->good("read-as usual");
    CHECK(opened->marks().reading == io::ReadOptions{});
    const std::size_t steps = opened->document.step_count();
    opened->good("read-as units auto"); // as it is
    CHECK(opened->document.step_count() == steps);
    CHECK(opened->bad("read-as").find("read-as units cm") != std::string::npos);
    CHECK(opened->bad("read-as units").find("pairs") != std::string::npos);
    CHECK(opened->bad("read-as units furlong").find("furlong") != std::string::npos);
    CHECK(opened->bad("read-as colour red").find("no option") != std::string::npos);
    // A repair that the file needs cannot be switched off: it says which.
    CHECK(opened->bad("read-as repair none").find("zero-radii") != std::string::npos);
    CHECK(opened.tree().points.size() == 5);
    std::ofstream(opened.folder.path() / "t.swc", std::ios::app) << "6 0 9 9 9 1 5\n";
    CHECK(opened->bad("read-as units cm").find("has changed") != std::string::npos);
}

TEST_CASE("note moves the camera to a repaired place, from the same side and close to it") {
    const Opened opened(kInCentimetres);
    const auto& notes = opened.tree().notes;
    const auto repaired = std::ranges::find(notes, "zero-radii", &tree::Note::topic);
    REQUIRE(repaired != notes.end());
    const render::Camera before = opened->document.session().camera;
    opened->good("note " + std::to_string(repaired - notes.begin() + 1));
    const render::Camera after = opened->document.session().camera;
    CHECK(after.focal_point == *repaired->at);
    CHECK(opened->host.leaps == 1);
    const glm::dvec3 way = glm::normalize(after.focal_point - after.position);
    CHECK(glm::distance(way, glm::normalize(before.focal_point - before.position)) < 1e-9);
    CHECK(glm::distance(after.position, after.focal_point) < glm::distance(before.position, before.focal_point));
    const auto whole = std::ranges::find(notes, "axes", &tree::Note::topic);
    CHECK(opened->bad("note " + std::to_string(whole - notes.begin() + 1)).find("whole tree") != std::string::npos);
    CHECK(opened->bad("note 99").find("from 1 to") != std::string::npos);
    CHECK(opened->bad("doctor").find("window") != std::string::npos);
}

namespace {

// Two tubes along x of labels 1 and 2, apart, and a speck of label 1 beyond their ends.
std::filesystem::path mask_of_tubes(const std::filesystem::path& path) {
    constexpr int kLength = 46, kSide = 24;
    test::NiftiFile file;
    file.dim = {3, kLength, kSide, 12, 1, 1, 1, 1};
    std::vector<std::uint8_t> voxels;
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kLength; ++x) {
                const bool along = x >= 2 && x < 38, first = (y - 6) * (y - 6) + (z - 6) * (z - 6) <= 16;
                const bool second = (y - 17) * (y - 17) + (z - 6) * (z - 6) <= 16;
                const bool speck = x >= 41 && x < 44 && y >= 5 && y < 7 && z >= 5 && z < 7;
                voxels.push_back(along && second ? 2 : (along && first) || speck ? 1 : 0);
            }
    file.put(voxels);
    return test::write_plain(path, file.bytes());
}

} // namespace

TEST_CASE("read-as skeletonizes a mask again, with other systems, islands and root, and keeps the view") {
    const TemporaryFolder folder;
    const auto path = mask_of_tubes(folder.path() / "m.nii");
    Job job;
    auto read = read_tree_or_mask(path, {}, 0.0, job);
    REQUIRE_MESSAGE(read, (read ? "" : read.error().message()));
    Session session;
    session.tree = {path, *checksum_of(path)};
    test::CommandStage stage(std::move(*read), std::move(session));
    const auto tree = [&]() -> const tree::VesselTree& { return *stage.document.tree(); };
    REQUIRE(tree().systems.size() == 2);
    REQUIRE(tree().roots.size() == 3);
    stage.good("colour-by system\nname-system 1 vein\nhide-system 2");
    const test::Ids hidden = stage.in(tree::BranchState::kHidden);
    REQUIRE(hidden.size() == 1);
    const render::Camera camera = stage.document.session().camera;

    CHECK(stage.good("read-as islands 10").starts_with("Read again: 2 branches"));
    CHECK(stage.last_step() == "read as islands 10");
    CHECK(tree().roots.size() == 2);
    CHECK(stage.document.session().camera == camera);
    const test::Ids now = stage.in(tree::BranchState::kHidden);
    REQUIRE(now.size() == 1);
    CHECK(tree().branches[static_cast<std::size_t>(now[0])].system == 1);
    CHECK(stage.marks().systems[0].name == "vein");

    stage.good("read-as root 39,6,6");
    CHECK(tree().points[tree().roots[0]].position.x > 30.0);
    stage.good("read-as labels together");
    CHECK(tree().systems.empty());
    CHECK(stage.marks().systems.empty());
    stage.good("undo");
    CHECK(stage.marks().systems[0].name == "vein");
    CHECK(stage.in(tree::BranchState::kHidden) == now);
    stage.good("read-as usual");
    CHECK(tree().roots.size() == 3);

    CHECK(stage.bad("read-as islands 500").find("islands") != std::string::npos);
}

TEST_CASE("options of masks are refused for tree files, and all options are refused for edited trees") {
    const Opened opened(kInCentimetres);
    CHECK(opened->bad("read-as fill-holes on").find("option of masks") != std::string::npos);
    opened->good("flip 0");
    CHECK(opened->bad("read-as units cm").find("edited") != std::string::npos);
}
