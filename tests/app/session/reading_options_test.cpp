// How a file is read: as people write it, as sessions keep it, and what of it could mislead.
#include "app/session/reading_options.h"
#include "app/session/session_file.h"
#include "core/io/trees/tree_file.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;

TEST_CASE("options of reading are written as text and read back without loss") {
    for (const char* text : {"mm", "cm", "um", "m", "0.62", "0.3x0.3x0.6", "0.123456789012345"}) {
        CAPTURE(text);
        CHECK(spelled(*io::length_unit(text)) == text);
    }
    for (unsigned bits = 0; bits <= static_cast<unsigned>(tree::Repair::kAll); ++bits)
        CHECK(repairs_in(spelled(static_cast<tree::Repair>(bits))) == static_cast<tree::Repair>(bits));
    CHECK_FALSE(repairs_in("zero-radii,teeth"));
    CHECK_FALSE(repairs_in(""));
}

TEST_CASE("an option is changed, removed, or refused with a list of its values") {
    const auto cm = with({}, "units", "cm");
    REQUIRE(cm);
    CHECK(cm->unit->mm.x == 10.0);
    CHECK(with(*cm, "units", "auto") == io::ReadOptions{});
    CHECK(with({}, "radius-is", "diameter")->radius_is == io::RadiusIs::kDiameter);
    CHECK(with({}, "axes", "lps")->orientation == io::Orientation::lps());
    CHECK(with({}, "repair", "none")->repair == tree::Repair::kNone);
    for (const auto& [key, word] :
         {std::pair("units", "um"), std::pair("radius-is", "diameter"), std::pair("axes", "sides"),
          std::pair("repair", "zero-radii"), std::pair("colour", "units")}) {
        const auto refused = with({}, key, "wrong");
        REQUIRE_FALSE(refused);
        CHECK(refused.error().hint.find(word) != std::string::npos);
    }
}

TEST_CASE("options of the command line take precedence over those of the session") {
    const auto session = with(*with({}, "units", "cm"), "repair", "none");
    CHECK(over({}, *session) == *session);
    const io::ReadOptions both = over(*with({}, "units", "um"), *session);
    CHECK(both.unit->mm.x == 1e-3);
    CHECK(both.repair == tree::Repair::kNone);
}

TEST_CASE("options of masks are set, removed, refused with a list of their values, and saved") {
    io::ReadOptions reading;
    for (const auto& row : {std::pair("labels", "1+3,2"), std::pair("fill-holes", "on"),
                            std::pair("bulge-size", "0.75"), std::pair("islands", "12.5"),
                            std::pair("root", "-1.5,0.1,3e2"), std::pair("channel", "2"), std::pair("time", "3")}) {
        const char* const key = row.first;
        const auto next = with(reading, key, row.second);
        REQUIRE(next);
        CHECK(*next != reading);
        CHECK(with(*next, key, "auto") == reading);
        reading = *next;
        for (const char* wrong : {"", "wrong", "1,", "-", "nan"}) {
            // Words are names of labels.
            if (key == std::string("labels") && std::string(wrong).find_first_not_of("1,") != std::string::npos)
                continue;
            const auto refused = with(reading, key, wrong);
            REQUIRE_FALSE_MESSAGE(refused, key, " ", wrong);
            CHECK(refused.error().hint.find(key) != std::string::npos);
        }
    }
    CHECK(reading.mask.labels == std::vector<std::vector<volume::LabelChoice>>{{1, 3}, {2}});
    CHECK(reading.mask.root == glm::dvec3(-1.5, 0.1, 300.0));
    CHECK(reading.part == io::VolumePart{2, 3});
    for (const char* none : {"0", "-1", "1.5"}) CHECK_FALSE(with({}, "channel", none));
    CHECK(over(*with({}, "time", "4"), reading).part == io::VolumePart{2, 4});
    CHECK(with({}, "labels", "together")->mask.labels->empty());
    CHECK(with(reading, "labels", "apart") == *with(reading, "labels", "auto"));
    CHECK_FALSE(with({}, "islands", "-1"));
    CHECK(over({}, reading) == reading);
    CHECK(over(*with({}, "islands", "3"), reading).mask.islands_mm == 3.0);

    const TemporaryFolder folder;
    Session session;
    session.tree.path = folder.path() / "m.nii";
    for (const char* labels : {"auto", "together", "1+3,2", "portal vein,\"7\"+2"}) {
        session.marks.reading = *with(reading, "labels", labels);
        REQUIRE(write_session(session, folder.path() / "s.json"));
        const auto again = read_session(folder.path() / "s.json");
        REQUIRE_MESSAGE(again, (again ? "" : again.error().message()));
        CHECK(again->session.marks.reading == session.marks.reading);
    }
    for (const char* wrong :
         {R"({"root": [1, 2]})", R"({"islands": -1})", R"({"fill_holes": 1})", R"({"labels": "x,"})"}) {
        nlohmann::json value = to_json(session, "/");
        value["reading"] = nlohmann::json::parse(wrong);
        CHECK_FALSE_MESSAGE(session_from_json(value, "/", "s.json"), wrong);
    }
}

TEST_CASE("sessions store the options of reading the tree") {
    const TemporaryFolder folder;
    Session session;
    session.tree.path = folder.path() / "t.swc";
    io::ReadOptions& reading = session.marks.reading;
    reading = *with(*with(*with(*with({}, "units", "0.3x0.4x0.61"), "radius-is", "diameter"), "axes", "lps"), "repair",
                    "zero-radii,radius-jumps");
    reading.columns = {{"x", "pos x"}};
    REQUIRE(write_session(session, folder.path() / "s.json"));
    const auto again = read_session(folder.path() / "s.json");
    REQUIRE(again);
    CHECK(again->session.marks.reading == reading);
    // As usual: nothing is said.
    CHECK_FALSE(to_json(Session{}, "/").contains("reading"));
    nlohmann::json wrong = to_json(session, "/");
    wrong["reading"]["units"] = "furlong";
    const auto refused = session_from_json(wrong, "/", "s.json");
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what.find("furlong") != std::string::npos);
}

TEST_CASE("a suspicious unit, an ambiguous radius and repaired radii can mislead; axes cannot") {
    const std::string plain = "1 0 0 0 0 5 -1\n2 0 0 0 200 5 1\n";
    const auto misleads = [](const std::string& swc, const io::ReadOptions& options = {}) {
        const auto tree = io::parse_tree(swc, "t.swc", options);
        REQUIRE(tree);
        return could_mislead(*tree, options);
    };
    CHECK_FALSE(misleads(plain));
    CHECK(misleads("1 0 0 0 0 0.2 -1\n2 0 0 0 20 0.2 1\n")); // cm, likely
    CHECK(misleads("1 0 0 0 0 5 -1\n2 0 0 0 200 0 1\n"));    // a radius was filled in
    CHECK_FALSE(misleads(plain + "3 0 0 0 200 5 2\n"));      // the same point twice
    CHECK(could_mislead({tree::Note::Kind::kAssumed, "radius-is", "", {}}, {}));
    CHECK_FALSE(could_mislead({tree::Note::Kind::kAssumed, "radius-is", "", {}}, *with({}, "radius-is", "radius")));
}
