#include "core/io/json_text.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

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
        CHECK(refused.error().what == "lists stand in lists, deeper than 64 levels");
    }
    CHECK_FALSE(io::parsed_json(std::string(1'000'000, '['), "a.json")); // never closed
    // Brackets in texts are text.
    CHECK(io::parsed_json("[\"" + std::string(1000, '[') + "\\\"" + std::string(1000, '{') + "\"]", "a.json"));
    CHECK(io::parsed_json("[" + nested(1, "[[", "]],") + nested(1, "[[", "]]") + "]", "a.json"));
}

TEST_CASE("JSON is printed whatever bytes a name has") {
    CHECK(io::printed_json(nlohmann::json{{"name", "a\xFF"}}, -1) == "{\"name\":\"a\xEF\xBF\xBD\"}");
    CHECK(io::printed_json(nlohmann::ordered_json{{"b", 1}, {"a", 2}}, -1) == "{\"b\":1,\"a\":2}");
}
