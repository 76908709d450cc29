#include "app/session/warnings.h"
#include "core/io/trees/tree_file.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

std::shared_ptr<const tree::VesselTree> read_swc(const std::string& swc, const char* orientation = nullptr) {
    io::ReadOptions options;
    if (orientation != nullptr) options.orientation = io::Orientation::named(orientation);
    auto tree = io::parse_tree(swc, "t.swc", options);
    REQUIRE(tree);
    return std::make_shared<const tree::VesselTree>(std::move(*tree));
}

// A radius of 0, and neither unit nor axes.
constexpr const char* kDamaged = "1 0 0 0 0 5 -1\n2 0 0 0 40 0 1\n3 0 0 0 80 5 2\n";

const Warning* about(const WarningList& list, const std::string& words) {
    for (const Warning& warning : list.all())
        if (warning.what.find(words) != std::string::npos) return &warning;
    return nullptr;
}

} // namespace

TEST_CASE("a warning is shown until it is read, and stays in the list") {
    WarningList list;
    list.add(Error{"the disk is full", "/data/plan.ramus.json", "make room"});
    CHECK(list.unread() == 1);
    CHECK(list.all()[0].where == "/data/plan.ramus.json");
    CHECK(list.all()[0].remedy == "make room");
    list.mark_read(0);
    CHECK(list.unread() == 0);
    CHECK(list.all().size() == 1);
    list.add(Error{"the disk is full", "/data/plan.ramus.json", "make room"}); // again
    CHECK(list.unread() == 1);
    CHECK(list.all().size() == 1);
    list.add(Error{"the disk is full", "/data/other.ramus.json", "make room"});
    CHECK(list.unread() == 2);
    list.mark_all_read();
    CHECK(list.unread() == 0);
    list.mark_read(99); // nobody's
}

TEST_CASE("notes of the tree are warnings; each says what, where and what to do") {
    WarningList list;
    const auto tree = read_swc(kDamaged);
    list.follow(tree, "/data/t.swc");
    CHECK(list.all().size() == note_groups(*tree).size());
    for (const Warning& warning : list.all()) {
        CHECK_FALSE(warning.what.empty());
        CHECK(warning.where == "/data/t.swc");
        CHECK_FALSE(warning.remedy.empty());
    }
    REQUIRE(about(list, "Orientation") != nullptr);
    CHECK(about(list, "Orientation")->command == "orientation");
    REQUIRE(about(list, "Repaired") != nullptr);
    CHECK(about(list, "Repaired")->command == "doctor");
}

TEST_CASE("another tree replaces the warnings of the previous tree, and read warnings stay read") {
    WarningList list;
    list.follow(read_swc(kDamaged), "/data/t.swc");
    list.mark_all_read();
    list.add(Error{"the disk is full", "/data/plan.ramus.json", "make room"});
    list.follow(read_swc(kDamaged, "LPS"), "/data/t.swc"); // read again in another way
    CHECK(about(list, "Repaired")->read);
    CHECK_FALSE(about(list, "as asked for")->read);
    CHECK(about(list, "does not say where") == nullptr);
    CHECK(about(list, "disk") != nullptr);
    list.follow(nullptr, {});
    CHECK(list.all().size() == 1);
}
