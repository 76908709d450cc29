// The organ of a session: what the cuts leave of it, in commands, figures, tables, territories and pictures.
#include "app/assets/operation.h"
#include "app/assets/organ_text.h"
#include "app/assets/territories.h"
#include "app/picture/territories.h"
#include "app/reports/table_kinds.h"
#include "app/session/session_file.h"
#include "core/io/volumes/volume_file.h"
#include "tests/support/organ_stage.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

using namespace ramus;
using namespace ramus::app;

using test::kVoxels;
using test::OrganStage;

namespace {

const int kFirst = test::first_voxels(); // nearest to branch 1

} // namespace

TEST_CASE("an organ is read, divided and measured, and a cut costs what the branch supplies") {
    OrganStage stage;
    CHECK(stage.organ().mask.value.value()->organ.count() == kVoxels);
    const auto whole = stage.operation();
    CHECK(whole->functional == kVoxels);
    CHECK(whole->remnant.both == kVoxels);

    stage.good("cut 1 0");
    const auto cut = stage.operation();
    CHECK(cut->of.supply == whole->of.supply); // not divided again
    CHECK(cut->remnant.lost == std::vector<double>{double(kFirst), 0});
    CHECK(cut->remnant.unsupplied() == kFirst);
    CHECK(cut->remnant.congested() == 0);

    // The roles the other way round: what the first system loses is now congested.
    stage.good("organ-role 1 drains\norgan-role \"hepatic vein\" supplies");
    CHECK(stage.operation()->remnant.congested() == kFirst);
}

TEST_CASE("lesions and large vessels are not part of the functional organ") {
    OrganStage stage;
    stage.good("lesion 10,5,0,3");
    std::size_t in_ball = 0;
    for (int x = -8; x < 18; ++x)
        for (int y = -10; y < 10; ++y)
            for (int z = -5; z < 7; ++z) in_ball += (x - 10) * (x - 10) + (y - 5) * (y - 5) + z * z <= 9 ? 1 : 0;
    CHECK(stage.operation()->functional == kVoxels - in_ball);
    stage.good("lesion-clear\norgan-large-vessels 4");
    CHECK(stage.operation()->functional < kVoxels);
    CHECK(stage.operation()->functional > kVoxels / 2);
}

TEST_CASE("the figures of an organ compare what remains with the patient's size") {
    OrganStage stage;
    stage.good("cut 1 0\norgan-patient 80 180\norgan-limits 0.6 25");
    CHECK(standard_liver_ml(80, 180).value() == doctest::Approx(-794.41 + 1267.28 * 2.0)); // surface: 2 m2
    CHECK_FALSE(standard_liver_ml(80, 0).has_value());
    CHECK_FALSE(standard_liver_ml(5, 40).has_value()); // the formula is one for adults
    const auto facts = organ_facts(*stage.operation(), stage.marks());
    const auto fact = [&](const std::string& label) {
        const auto found = std::ranges::find(facts, label, &OrganFact::label);
        REQUIRE_MESSAGE(found != facts.end(), label);
        return *found;
    };
    CHECK(fact("Organ").volume.value() == doctest::Approx(kVoxels));
    CHECK(fact("Keeps both").percent.value() == doctest::Approx(100.0 * (kVoxels - kFirst) / kVoxels));
    CHECK(fact("portal vein loses").volume.value() == doctest::Approx(kFirst));
    CHECK(fact("Of the body's weight").percent.value() ==
          doctest::Approx(100.0 * (kVoxels - kFirst) / 1000.0 / 80000.0));
    CHECK(fact("Of the standard liver").percent.value() ==
          doctest::Approx(100.0 * (kVoxels - kFirst) / 1000.0 / (-794.41 + 1267.28 * 2.0)));
    CHECK(fact("Of the standard liver").help.find("25 %") != std::string::npos);

    const TableKind& kind = *table_kind_named("organ");
    (void)stage.current_assets();
    CHECK(kind.there(stage.document, stage.assets));
    CHECK(kind.table(stage.document, stage.assets).rows.size() == facts.size());
}

TEST_CASE("territories follow the choice, and divide the organ without rest") {
    OrganStage stage;
    const auto sizes = [&] {
        std::vector<std::size_t> voxels;
        std::size_t sum = 0;
        for (const auto& part : stage.organ().territories->parts) {
            CHECK(part.mesh->triangles.size() > 100);
            voxels.push_back(part.voxels);
            sum += part.voxels;
        }
        CHECK(sum == kVoxels);
        return voxels;
    };
    using Sizes = std::vector<std::size_t>;
    const Sizes halves{std::size_t(kFirst), std::size_t(kVoxels - kFirst)};
    CHECK(sizes() == Sizes{kVoxels}); // the whole organ, once it is read
    stage.good("territories generation 1");
    CHECK(sizes() == halves);
    stage.good("select 1\nterritories selection");
    CHECK(sizes() == halves);
    CHECK(stage.organ().territories->parts[1].rest);
    stage.good("name 1 S1\nname 2 S2\nterritories names");
    CHECK(sizes() == halves);
    CHECK(stage.organ().territories->parts[0].name == "S1");
    stage.good("name 2 S1");
    CHECK(sizes() == Sizes{kVoxels}); // branches of one name have one territory
    stage.good("cut 1 0\nterritories cuts");
    CHECK(sizes() == halves);
    stage.good("territories remnant");
    CHECK(sizes() == Sizes{halves[1], halves[0]});
    CHECK(stage.organ().territories->parts[1].name == "not supplied");
    stage.good("territories generation 0 --system 2");
    CHECK(sizes() == Sizes{kVoxels});

    const render::Frame frame = compose(stage.document.session(), stage.assets, nullptr, {});
    REQUIRE(frame.context.size() == 1);
    CHECK(frame.context[0].opacity == doctest::Approx(0.4));
    CHECK(frame.overlays.legend.swatches.back().text.find("ml") != std::string::npos);
    stage.good("territories off");
    CHECK(compose(stage.document.session(), stage.assets, nullptr, {}).context.empty());
}

TEST_CASE("an organ comes back with its session, and undo takes it away") {
    OrganStage stage;
    stage.good("organ-patient 70\nterritories generation 1 --system 1");
    const auto read = session_from_json(to_json(stage.document.session(), "/data"), "/data", "s.json");
    REQUIRE(read);
    CHECK(read->session.marks.organ == stage.marks().organ);
    for (int step = 0; step < 4; ++step) stage.good("undo");
    CHECK_FALSE(stage.marks().organ.any());
}

TEST_CASE("commands of organs refuse what they cannot do, and say what they can") {
    OrganStage stage;
    for (const char* line : {"organ-by nearest", "organ-role 1", "organ-role 1 both", "organ-role 7 drains",
                             "organ-large-vessels -1", "organ-patient heavy", "organ-patient 1 2 3", "organ-limits 1",
                             "territories", "territories lobes", "territories generation -1", "territories names 3",
                             "territories names --system 9", "territories-opacity 2", "organ nowhere.nii"})
        stage.bad(line);
    CHECK(stage.bad("organ \"" + stage.mask + "\" --label 9").find('9') != std::string::npos);
    CHECK(stage.bad("organ \"" + stage.mask + "\" --units ell").find("unit") != std::string::npos);
    stage.good("organ-clear");
    CHECK(stage.bad("territories organ").find("organ FILE") != std::string::npos);
}

TEST_CASE("the territories that are shown are written as labels and as surfaces") {
    OrganStage stage;
    const auto file = [&](const char* name) { return (stage.folder.path() / name).string(); };
    CHECK(stage.bad("export territories \"" + file("a.nii.gz") + "\"").find("no territories") != std::string::npos);
    stage.good("name 1 S1\nname 2 S2\nterritories names");
    const auto territories = stage.organ().territories;
    REQUIRE(territories->parts.size() == 2);
    for (const char* name : {"a.nii.gz", "a.seg.nrrd"}) {
        stage.good("export territories \"" + file(name) + "\"");
        Job job;
        const auto read = io::read_volume(file(name), {}, job);
        REQUIRE(read);
        REQUIRE(read->label_names.size() == 2);
        CHECK(read->label_names[1].name == "S2");
        for (std::int32_t label : {1, 2}) {
            const auto part = organ::organ_of(*read, {{volume::LabelChoice(label)}, {}}, JobRange(job, 0.0F, 1.0F));
            REQUIRE(part);
            CHECK(part->count() == territories->parts[static_cast<std::size_t>(label - 1)].voxels);
        }
    }
    stage.good("export territories \"" + file("a.stl") + "\"");
    CHECK(std::filesystem::exists(file("a-S1.stl")));
    CHECK(std::filesystem::exists(file("a-S2.stl")));
    stage.good("export territories \"" + file("a.vtp") + "\"");
    CHECK(std::filesystem::exists(file("a.vtp")));
    CHECK(stage.bad("export territories \"" + file("a.png") + "\"").find(".seg.nrrd") != std::string::npos);
}
