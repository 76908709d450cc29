#include "core/io/json_text.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

using namespace ramus;

TEST_CASE("JSON nests so deep and no deeper") {
    const auto nested = [](int levels, const std::string& open, const std::string& close) {
        std::string text;
        for (int i = 0; i < levels; ++i) text += open;
        for (int i = 0; i < levels; ++i) text += close;
        return text;
    };
    CHECK(io::parsed_json(nested(io::kDeepestJson, "[", "]"), "a.json"));
    for (const int levels : {io::kDeepestJson + 1, 300'000}) {
        const auto refused = io::parsed_json("{\"a\":\n" + nested(levels - 1, "[", "]") + "}", "a.json");
        REQUIRE_FALSE(refused);
        CHECK(refused.error().where == "a.json:2");
        CHECK(refused.error().what == "lists are nested deeper than 64 levels");
    }
    CHECK_FALSE(io::parsed_json(std::string(1'000'000, '['), "a.json")); // never closed
    // Brackets in texts are text.
    CHECK(io::parsed_json("[\"" + std::string(1000, '[') + "\\\"" + std::string(1000, '{') + "\"]", "a.json"));
    CHECK(io::parsed_json("[" + nested(1, "[[", "]],") + nested(1, "[[", "]]") + "]", "a.json"));
}

TEST_CASE("JSON takes so much memory and no more" * doctest::test_suite("slow")) {
    const std::pair<std::string, std::size_t> elements[] = {
        {"1", 24}, {"[]", 88}, {"{}", 88}, {"\"\"", 72}, {R"({"a":0})", 209}};
    for (const auto& [element, bytes] : elements) {
        const std::size_t count = io::kMostJsonBytes / bytes + 1;
        std::string text = "{\"a\":[" + element;
        for (std::size_t n = 1; n < count; ++n) text += "," + element;
        text += "]}";
        const auto refused = io::parsed_json(text, "a.json");
        REQUIRE_FALSE(refused);
        CHECK(refused.error().message() == "a.json: its values would take more than 128 MiB of memory; no file of this "
                                           "kind has as many; check the program that wrote it");
        std::size_t taken = 0;
        const auto list = io::parsed_json(text, "a.json", [&](io::JsonPath path) -> io::JsonElements {
            if (path.size() > 1) return {};
            return [&](const nlohmann::json& /*value*/) { ++taken; };
        });
        REQUIRE(list);
        CHECK(*list == nlohmann::json{{"a", nlohmann::json::array()}});
        CHECK(taken == count);
    }
}

TEST_CASE("lists of JSON are taken as they are read") {
    std::vector<std::string> taken;
    const auto take = [&](io::JsonPath path) -> io::JsonElements {
        std::string name;
        for (const std::string& key : path) name += "/" + key;
        if (name == "/a/" || name == "/a" || name == "/o/b")
            return [&, name](const nlohmann::json& value) { taken.push_back(name + " " + value.dump()); };
        return {};
    };
    const auto rest =
        io::parsed_json(R"({"a":[1,[2,{"c":[3]}],[],"x"],"o":{"b":[null],"k":[4,[5]]},"k":6.5})", "a", take);
    REQUIRE(rest);
    CHECK(rest->dump() == R"({"a":[],"k":6.5,"o":{"b":[],"k":[4,[5]]}})");
    CHECK(taken ==
          std::vector<std::string>{"/a 1", "/a/ 2", R"(/a/ {"c":[3]})", "/a []", "/a []", "/a \"x\"", "/o/b null"});
    CHECK_THROWS_AS((void)io::parsed_json("[1]", "a", [](io::JsonPath) { return [](auto&) { throw 1; }; }), int);
}

TEST_CASE("names at the top of JSON") {
    const auto names = [](const std::string& text) {
        std::istringstream stream(text);
        return io::json_names(stream);
    };
    CHECK(names(R"({"a":{"b":[{"c":1}]},"d":null})") == std::vector<std::string>{"a", "d"});
    for (const std::string& text : {std::string("[]"), std::string("1"), std::string("{\"a\":1"), std::string(),
                                    "{\"a\":" + std::string(100'000, '[')})
        CHECK(names(text).empty());
}

TEST_CASE("JSON is printed whatever bytes a name has") {
    CHECK(io::printed_json(nlohmann::json{{"name", "a\xFF"}}, -1) == "{\"name\":\"a\xEF\xBF\xBD\"}");
    CHECK(io::printed_json(nlohmann::ordered_json{{"b", 1}, {"a", 2}}, -1) == "{\"b\":1,\"a\":2}");
}
