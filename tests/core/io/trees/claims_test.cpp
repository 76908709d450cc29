// Who says what unit a tree has and how the patient lies: from a file to a tree, and on to every file that is written.
#include "core/io/orientation.h"
#include "core/io/trees/tree_file.h"
#include "core/tree/edit_tree.h"
#include "core/tree/part_of_tree.h"
#include "core/tree/prepare.h"
#include "tests/support/round_trip.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using tree::SaidBy;

namespace {

constexpr const char* kBare = "1 0 1 2 3 1 -1\n2 0 11 2 3 1 1\n3 0 11 22 3 1 2\n4 0 11 2 33 1 2\n";

tree::VesselTree read(const std::string& text, const io::ReadOptions& options = {}) {
    auto tree = io::parse_tree(text, "t.swc", options);
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    return std::move(*tree);
}

io::ReadOptions saying(const char* orientation, const char* unit = nullptr) {
    io::ReadOptions options;
    if (orientation != nullptr) options.orientation = io::Orientation::named(orientation);
    if (unit != nullptr) options.unit = io::length_unit(unit);
    return options;
}

std::string notes_of(const tree::VesselTree& tree, tree::Note::Kind kind, const std::string& topic) {
    std::string all;
    for (const tree::Note& note : tree.notes)
        if (note.kind == kind && note.topic == topic) all += note.text + "\n";
    return all;
}

const tree::Claims kNobody{SaidBy::kNobody, SaidBy::kNobody}, kFile{SaidBy::kFile, SaidBy::kFile};

} // namespace

TEST_CASE("what a file does not say nobody has said, until a person does") {
    CHECK(read(kBare).claims == kNobody);
    CHECK(read(std::string("# id type x y z radius parent (mm, RAS)\n") + kBare).claims == kFile);
    CHECK(read(kBare, saying("LPS")).claims == tree::Claims{SaidBy::kNobody, SaidBy::kPerson});
    CHECK(read(kBare, saying(nullptr, "cm")).claims == tree::Claims{SaidBy::kPerson, SaidBy::kNobody});
    // Against what the file says, it is the person's word.
    CHECK(read(std::string("# id type x y z radius parent (mm, RAS)\n") + kBare, saying("LPS")).claims.orientation ==
          SaidBy::kPerson);
}

TEST_CASE("all 48 orientations are applied to the file's numbers; those that mirror leave a suspicion") {
    const tree::VesselTree bare = read(kBare);
    for (const io::Orientation& one : io::all_orientations()) {
        CAPTURE(one.letters());
        const tree::VesselTree said = read(kBare, saying(one.letters().c_str()));
        REQUIRE(said.points.size() == bare.points.size());
        for (std::size_t p = 0; p < bare.points.size(); ++p)
            CHECK(said.points[p].position == one.to_patient(bare.points[p].position));
        // The hand of three directions out of a point: as in the file, or the other one.
        const auto hand = [](const tree::VesselTree& tree) {
            const glm::dvec3 at = tree.points[1].position;
            return glm::dot(glm::cross(tree.points[0].position - at, tree.points[2].position - at),
                            tree.points[3].position - at);
        };
        CHECK((hand(said) * hand(bare) < 0.0) == one.mirrors());
        CHECK(notes_of(said, tree::Note::Kind::kSuspect, "axes").empty() != one.mirrors());
    }
}

TEST_CASE("what is derived from a tree claims no more than the tree") {
    const tree::VesselTree bare = read(kBare);
    CHECK(tree::part_of(bare, std::vector<std::uint8_t>{1, 1, 0}).claims == kNobody);
    const auto edited =
        tree::apply(bare, {.kind = tree::Edit::Kind::kRadius, .branches = {0}, .fractions = {}, .value = 2.0});
    REQUIRE(edited);
    CHECK(edited->tree.claims == kNobody);
}

TEST_CASE("a file that is written of a tree says what is known of it, and no more") {
    for (const io::TreeFormat& format : io::tree_formats()) {
        if (!io::is_written(format)) continue;
        const std::string extension(format.extensions.front());
        CAPTURE(extension);
        const bool tells = extension != ".csv"; // has no place for it
        const tree::VesselTree bare = read(kBare);
        const tree::VesselTree again = test::through_a_file(bare, extension);
        CHECK(again.claims == kNobody);
        for (std::size_t p = 0; p < bare.points.size(); ++p)
            CHECK(std::ranges::find(again.points, bare.points[p]) != again.points.end()); // the numbers stay
        const tree::VesselTree said = read(kBare, saying("PIR", "cm"));
        CHECK(test::through_a_file(said, extension).claims == (tells ? kFile : kNobody));
        const tree::VesselTree half = read(kBare, saying("PIR"));
        CHECK(test::through_a_file(half, extension).claims ==
              (tells ? tree::Claims{SaidBy::kNobody, SaidBy::kFile} : kNobody));
    }
}

TEST_CASE("an assumption that a file kept is told once, and not at all when somebody has answered it") {
    const tree::VesselTree again = test::through_a_file(read(kBare), ".json");
    CHECK(std::ranges::count(again.notes, std::string("axes"), &tree::Note::topic) == 1);
    CHECK(std::ranges::count(again.notes, std::string("units"), &tree::Note::topic) ==
          std::ranges::count(read(kBare).notes, std::string("units"), &tree::Note::topic));
    const TemporaryFolder folder;
    const auto file = folder.path() / "t.json";
    REQUIRE(io::write_tree(read(kBare), file));
    const auto answered = io::read_tree(file, saying("LPS", "mm"));
    REQUIRE(answered);
    CHECK(notes_of(*answered, tree::Note::Kind::kAssumed, "axes").find("as asked for") != std::string::npos);
    CHECK(notes_of(*answered, tree::Note::Kind::kAssumed, "axes").find("taken as") == std::string::npos);
    CHECK(notes_of(*answered, tree::Note::Kind::kAssumed, "units").find("taken as") == std::string::npos);
}

TEST_CASE("texts of a tree without a unit say units where they would say mm") {
    const tree::Claims open = kNobody;
    CHECK(kFile.worded("Length, mm") == "Length, mm");
    CHECK(open.worded("Length, mm") == "Length, units");
    CHECK(open.worded("3 mm, 4 mm\xC2\xB2 (mm) 5 mm3") == "3 units, 4 units\xC2\xB2 (units) 5 units3");
    CHECK(open.worded("/data/mm/tree.swc, a_mm.csv, hammer, mmol, 5 mm_x") ==
          "/data/mm/tree.swc, a_mm.csv, hammer, mmol, 5 mm_x");
    CHECK(open.unit_word() == "unknown");
    CHECK(open.axes_word() == "unknown");
}
