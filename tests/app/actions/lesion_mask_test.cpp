// Lesions that are parts of a mask.
#include "app/assets/lesion_text.h"
#include "app/picture/scene_objects.h"
#include "app/session/session_file.h"
#include "core/io/trees/tree_file.h"
#include "tests/support/command_stage.h"
#include "tests/support/nifti_file.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace ramus;
using namespace ramus::app;

namespace {

constexpr double kVoxel = 0.5; // mm
const glm::ivec3 kMaskSize(56, 56, 40);
const glm::dvec3 kMaskOrigin(-16, -22, -2);

struct Ball {
    glm::dvec3 centre;
    double radius;
    std::uint8_t label;
};
const std::vector<Ball> kBalls{{{-10, 0, 5}, 3.0, 2}, {{4, -14, 10}, 5.0, 3}};

glm::dvec3 place_of(int n) {
    return kMaskOrigin +
           kVoxel * glm::dvec3(n % kMaskSize.x, n / kMaskSize.x % kMaskSize.y, n / kMaskSize.x / kMaskSize.y);
}

std::vector<std::uint8_t> balls(bool labelled) {
    std::vector<std::uint8_t> values(static_cast<std::size_t>(kMaskSize.x * kMaskSize.y * kMaskSize.z));
    for (std::size_t n = 0; n < values.size(); ++n)
        for (const Ball& ball : kBalls)
            if (glm::distance(place_of(static_cast<int>(n)), ball.centre) <= ball.radius)
                values[n] = labelled ? ball.label : 1;
    return values;
}

std::string write_mask(const TemporaryFolder& folder, const std::string& name,
                       const std::vector<std::uint8_t>& values) {
    test::NiftiFile file;
    file.dim = {3, kMaskSize.x, kMaskSize.y, kMaskSize.z, 1, 1, 1, 1};
    file.pixdim = {1, kVoxel, kVoxel, kVoxel, 1, 1, 1, 1};
    file.rows = {kVoxel, 0, 0, kMaskOrigin.x, 0, kVoxel, 0, kMaskOrigin.y, 0, 0, kVoxel, kMaskOrigin.z};
    file.put(values);
    return test::write_plain(folder.path() / name, file.bytes()).string();
}

// A stem of 10 mm along z, r 3, and 8 mm along x, r 2, from its end.
tree::VesselTree two_branches() {
    return io::parse_tree("# id type x y z radius parent (mm, RAS)\n1 0 0 0 0 3 -1\n2 0 0 0 10 3 1\n3 0 1 0 10 2 2\n"
                          "4 0 8 0 10 2 3\n5 0 0 1 10 1 2\n6 0 0 6 10 1 5\n",
                          "tree.swc")
        .value();
}

double enclosed_mm3(const mesh::TriangleMesh& mesh) {
    double sum = 0.0;
    for (const auto& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

} // namespace

TEST_CASE("the parts of a mask are lesions, with volume, diameter and distances to vessels") {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> values = balls(false);
    const std::string file = write_mask(folder, "tumours.nii", values);
    test::CommandStage stage(two_branches());
    const std::string said = stage.good("lesion-mask \"" + file + "\"");
    CHECK(said.starts_with("2 lesions of the mask: "));
    REQUIRE(stage.marks().lesions.size() == 2);
    CHECK(stage.document.step_count() == 1);
    const Assets& assets = stage.current_assets();
    CHECK(assets.lesion_files.size() == 1); // read once
    for (std::size_t n = 0; n < 2; ++n) {
        const Ball& ball = kBalls[1 - n]; // the largest first
        const Lesion& lesion = stage.marks().lesions[n];
        CHECK(lesion.part == static_cast<int>(n) + 1);
        const auto mesh = assets.lesion_mesh(lesion);
        REQUIRE(mesh);
        double voxels = 0.0, to_branch = std::numeric_limits<double>::max();
        for (std::size_t i = 0; i < values.size(); ++i) {
            const glm::dvec3 at = place_of(static_cast<int>(i));
            if (glm::distance(at, ball.centre) > ball.radius) continue;
            voxels += kVoxel * kVoxel * kVoxel;
            // Walls: the stem's from z = 0 to 10, the branch's from x = 1 to 8.
            const double stem = std::hypot(std::hypot(at.x, at.y) - 3.0, at.z - std::clamp(at.z, 0.0, 10.0));
            const double along = std::hypot(std::hypot(at.y, at.z - 10.0) - 2.0, at.x - std::clamp(at.x, 1.0, 8.0));
            to_branch = std::min({to_branch, stem, along});
        }
        CHECK(mesh->volume_mm3.value() == doctest::Approx(voxels).epsilon(1e-9));
        CHECK(enclosed_mm3(mesh->mesh) == doctest::Approx(voxels).epsilon(0.01));
        CHECK(voxels == doctest::Approx(4.0 / 3.0 * std::numbers::pi * std::pow(ball.radius, 3)).epsilon(0.03));
        CHECK(std::abs(mesh->diameter_mm - 2.0 * ball.radius) < kVoxel);
        const auto& vessels = stage.plan()->vessels;
        const auto found = std::ranges::find(vessels, n, &measure::LesionVessels::lesion);
        REQUIRE(found != vessels.end());
        CHECK(std::abs(found->nearest.distance_mm - to_branch) < kVoxel);
        const ObjectWords words = words_of(lesion, n, assets, Lengths());
        CHECK(words.title == "Lesion " + std::to_string(n + 1));
        CHECK(words.value == size_text(*mesh, Lengths()));
        CHECK(words.value.find("mm") != std::string::npos);
    }
    stage.good("undo");
    CHECK(stage.marks().lesions.empty());
    stage.good("redo");
    CHECK(stage.bad("lesion-mask \"" + file + "\"").find("there already") != std::string::npos);
    CHECK(stage.bad("lesion-axes 1 LPS").find("states its axes itself") != std::string::npos);
    // Only what was taken away comes back.
    CHECK(stage.good("lesion-remove 1\nlesion-mask \"" + file + "\"").starts_with("1 lesion of the mask"));
    CHECK(stage.marks().lesions.size() == 2);
    CHECK(stage.marks().lesions.back().part == 1);
}

TEST_CASE("labels of a mask are divided on their own, and a session names the part") {
    const TemporaryFolder folder;
    const std::string file = write_mask(folder, "labels.nii", balls(true));
    test::CommandStage stage(two_branches());
    stage.good("lesion-mask \"" + file + "\" --label 2 --units mm\nobject-name lesion 1 \"my lesion\"");
    REQUIRE(stage.marks().lesions.size() == 1);
    const Lesion& lesion = stage.marks().lesions.front();
    CHECK(lesion.labels == std::vector<volume::LabelChoice>{2});
    stage.good("lesion-mask \"" + file + "\" --label 3,2");
    CHECK(stage.marks().lesions.size() == 3); // asked for in another way

    const auto read = session_from_json(to_json(stage.document.session(), folder.path()), folder.path(), "s.json");
    REQUIRE(read);
    CHECK(read->session.marks.lesions == stage.marks().lesions);
    test::CommandStage again(two_branches(), read->session);
    const auto plan = again.plan();
    CHECK(plan->troubles.empty());
    CHECK(again.assets.lesion_files.size() == 2);
    const auto mesh = again.assets.lesion_mesh(again.marks().lesions[0]);
    REQUIRE(mesh);
    CHECK(std::abs(mesh->diameter_mm - 6.0) < kVoxel);

    // A mask that has changed since, and lost a part, says so.
    Session session = read->session;
    session.marks.lesions[2].part = 7;
    test::CommandStage lost(two_branches(), session);
    const auto troubles = lost.plan()->troubles;
    REQUIRE(troubles.size() == 1);
    CHECK(troubles[0].find("no part 7") != std::string::npos);
    CHECK(words_of(lost.marks().lesions[2], 2, lost.assets, Lengths()).trouble);
}

TEST_CASE("of a mask with many parts the largest are lesions, and the rest are counted") {
    const TemporaryFolder folder;
    std::vector<std::uint8_t> values(static_cast<std::size_t>(kMaskSize.x * kMaskSize.y * kMaskSize.z));
    for (std::size_t n = 0; n < 60; ++n) values[4 * (n % 14) + 2 * 56 * (n / 14)] = 1; // in every second row
    values[1] = 1;                                                                     // the first is larger
    const std::string file = write_mask(folder, "specks.nii", values);
    test::CommandStage stage(two_branches());
    CHECK(stage.good("lesion-mask \"" + file + "\"").find("10 smaller parts are left out") != std::string::npos);
    REQUIRE(stage.marks().lesions.size() == kMostLesionParts);
    const double voxel = kVoxel * kVoxel * kVoxel;
    const Assets& assets = stage.current_assets();
    CHECK(assets.lesion_mesh(stage.marks().lesions[0])->volume_mm3.value() == doctest::Approx(2.0 * voxel));
    const auto smallest = assets.lesion_mesh(stage.marks().lesions.back());
    CHECK(enclosed_mm3(smallest->mesh) == doctest::Approx(voxel).epsilon(0.01));
}

TEST_CASE("masks that have no lesion are refused") {
    const TemporaryFolder folder;
    const std::string empty = write_mask(folder, "empty.nii", std::vector<std::uint8_t>(balls(false).size()));
    const std::string file = write_mask(folder, "labels.nii", balls(true));
    test::CommandStage stage(two_branches());
    CHECK(stage.bad("lesion-mask \"" + empty + "\"").find("empty.nii") != std::string::npos);
    CHECK(stage.bad("lesion-mask missing.nii").find("missing.nii") != std::string::npos);
    CHECK(stage.bad("lesion-mask \"" + file + "\" --label 9").find('9') != std::string::npos);
    CHECK(stage.bad("lesion-mask \"" + file + "\" --label").find("--label and --units") != std::string::npos);
    CHECK(stage.bad("lesion-mask \"" + file + "\" --units foot").find("foot") != std::string::npos);
    CHECK(stage.bad("lesion-mask tumour.stl").find("no mask") != std::string::npos);
    CHECK(stage.bad("lesion-mask").find("FILE") != std::string::npos);
    CHECK(stage.assets.lesion_files.empty());
}
