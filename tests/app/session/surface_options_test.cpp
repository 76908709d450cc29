#include "app/session/session_file.h"
#include "app/session/surface_options.h"
#include "core/io/trees/swc.h"
#include "tests/support/command_stage.h"

#include <doctest/doctest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

using namespace ramus;
using namespace ramus::app;

namespace {

// Another value than the option's default, which it takes.
double other_value(const SurfaceOption& option) {
    const double value = option.value({}) + 1.0;
    REQUIRE(takes(option, value));
    return value;
}

} // namespace

TEST_CASE("every option of the surface has a complete row") {
    std::set<std::string_view> keys;
    for (const SurfaceOption& option : surface_options()) {
        CAPTURE(option.key);
        CHECK(keys.insert(option.key).second);
        CHECK(surface_option(option.key) == &option);
        CHECK_FALSE(option.unit.empty());
        CHECK_FALSE(option.help.empty());
        CHECK_FALSE(option.domain.empty());
        CHECK(option.least < option.most);
        CHECK((option.only_when_set || takes(option, option.value({}))));
        CHECK_FALSE(takes(option, option.least - 1.0));
        CHECK_FALSE(takes(option, std::numeric_limits<double>::quiet_NaN()));
        CHECK_FALSE(takes(option, std::numeric_limits<double>::infinity()));
        CHECK(takes(option, 4.5) != option.whole);
        mesh::SurfaceOptions options;
        option.set(options, other_value(option));
        CHECK(option.value(options) == other_value(option));
        CHECK(options != mesh::SurfaceOptions{});
        if (!option.instead.empty()) CHECK(surface_option(option.instead) != nullptr);
        if (option.label.empty()) continue;
        CHECK(option.of_session);
        CHECK_FALSE(option.tooltip.empty());
        CHECK(takes(option, option.slider_least));
        CHECK(takes(option, option.slider_most));
        CHECK(surface_command_help().find(option.key) != std::string::npos);
    }
    CHECK(surface_option("colour") == nullptr);
}

TEST_CASE("an option with a list of words accepts only these words") {
    const SurfaceOption* blend = surface_option("blend");
    REQUIRE(blend != nullptr);
    for (const mesh::BlendRow& row : mesh::kBlends) {
        const auto value = value_in(*blend, std::string(row.key));
        REQUIRE(value);
        CHECK(spelled(*blend, *value) == row.key);
        mesh::SurfaceOptions options;
        blend->set(options, *value);
        CHECK(options.blend == row.blend);
    }
    for (const char* wrong : {"", "1", "trees", "Tree", "paper "}) CHECK_FALSE(value_in(*blend, wrong));
    CHECK(value_in(*surface_option("width"), "2.5") == 2.5);
    for (const char* wrong : {"", "2.5 ", "0", "nan", "5x", "tree"})
        CHECK_FALSE(value_in(*surface_option("width"), wrong));

    for (const nlohmann::json& wrong : {nlohmann::json(1), nlohmann::json("trees"), nlohmann::json(nullptr)}) {
        nlohmann::json value = to_json(Session{}, "/");
        CHECK(value["options"]["blend"] == "tree");
        value["options"]["blend"] = wrong;
        CHECK_FALSE(session_from_json(value, "/", "s.json"));
    }
}

TEST_CASE("an old session without a choice of blend shows the plain sum") {
    nlohmann::json value = to_json(Session{}, "/");
    value["options"].erase("blend");
    const auto before = session_from_json(value, "/", "s.json");
    REQUIRE(before);
    CHECK(before->session.marks.options.blend == mesh::Blend::kPaper);
    value.erase("options"); // written by hand: as by default
    const auto by_hand = session_from_json(value, "/", "s.json");
    REQUIRE(by_hand);
    CHECK(by_hand->session.marks.options == mesh::SurfaceOptions{});
}

TEST_CASE("a session stores the kernel unless it is the Gaussian, and is refused if the kernel is unknown") {
    Session session;
    CHECK_FALSE(to_json(session, "/")["options"].contains("kernel")); // as sessions were before there was a choice
    for (const field::KernelRow& row : field::kernel_rows()) {
        CAPTURE(row.key);
        session.marks.options.kernel = row.kind;
        CHECK(surface_option("kernel")->domain.find(row.key) != std::string_view::npos);
        const auto read = session_from_json(to_json(session, "/"), "/", "s.json");
        REQUIRE(read);
        CHECK(read->session.marks.options.kernel == row.kind);
    }
    nlohmann::json value = to_json(session, "/");
    CHECK(value["options"]["kernel"] == "polynomial");
    value["options"]["kernel"] = "quintic";
    CHECK_FALSE(session_from_json(value, "/", "s.json"));
}

TEST_CASE("options of the session are saved under their keys and read back, options of the machine are not") {
    for (const SurfaceOption& option : surface_options()) {
        CAPTURE(option.key);
        Session session;
        option.set(session.marks.options, other_value(option));
        const nlohmann::json value = to_json(session, "/");
        CHECK(value["options"].contains(std::string(option.key)) == option.of_session);
        const auto read = session_from_json(value, "/", "s.json");
        REQUIRE(read);
        CHECK((read->session.marks.options == session.marks.options) == option.of_session);
    }
}

TEST_CASE("every option with a slider can be set by a command") {
    test::CommandStage stage(*io::parse_tree("1 0 0 0 0 1 -1\n2 0 0 0 9 1 1\n", "small.swc"));
    for (const SurfaceOption& option : surface_options()) {
        CAPTURE(option.key);
        const std::string line = "surface " + std::string(option.key) + " " + spelled(option, other_value(option));
        if (option.label.empty()) {
            CHECK(stage.bad(line).find("surface takes") != std::string::npos);
            continue;
        }
        stage.good(line);
        CHECK(option.value(stage.document.marks().options) == other_value(option));
    }
    for (const mesh::MethodRow& row : mesh::kMethods) {
        CAPTURE(row.key);
        const std::string line = "surface method " + std::string(row.key);
        if (row.of_tree)
            stage.good(line);
        else
            stage.bad(line);
        CHECK((stage.document.marks().options.method == row.method) == row.of_tree);
        CHECK(mesh::method_named(row.key) == row.method);
        CHECK(mesh::row_of(row.method).key == row.key);
    }
}
