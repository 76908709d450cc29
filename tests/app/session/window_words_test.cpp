#include "app/session/window_words.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

using namespace ramus::app;

TEST_CASE("advice in the window mentions no option and no command line") {
    for (const char* const advice :
         {"lower --detail, or prune with --prune", "use .ply, a lower --detail, or more --memory",
          "ramus info lists the labels of a mask", "choose an --isovalue, or a --label",
          "allow it with --repair usual or --repair radii, or edit the file", "crop it, or allow more with --memory",
          "that is too large for a patient; --units um may be what is meant", "give --blend paper, or a larger --width",
          "ramus mesh --method iso makes the surface of a mask", "lower --islands", "give a smaller --size",
          "edit the file or write it anew with `ramus convert`"}) {
        const std::string words = window_words(advice);
        CAPTURE(words);
        CHECK(words.find("--") == std::string::npos);
        CHECK(words.find("ramus ") == std::string::npos);
        CHECK_FALSE(words.empty());
    }
    CHECK(window_words("lower --detail, or prune with --prune") == "lower the detail, or prune");
    CHECK(window_words("use a lower --detail, or .ply") == "use a lower detail, or .ply");
    CHECK(window_words("radius -0.3 is not positive") == "radius -0.3 is not positive");
    CHECK(window_words("a -- b") == "a -- b");
}

namespace {

namespace fs = std::filesystem;

// The literals of a source file, those behind each other joined, without comments.
std::vector<std::string> literals_of(const fs::path& file) {
    std::ifstream stream(file);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    text = std::regex_replace(text, std::regex(R"((^|\n)\s*//[^\n]*)"), "\n");
    text = std::regex_replace(text, std::regex(R"("\s*\n\s*")"), "");
    const std::regex literal(R"re("((?:[^"\\\n]|\\.)*)")re");
    std::vector<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), literal), end; at != end; ++at) found.push_back((*at)[1]);
    return found;
}

bool of_command_line(const std::string& text) {
    static const std::regex flag(R"((^|[ (,])--[a-z])"),
        command(R"(\bramus (info|mesh|convert|compare|render|skeletonize|study|validate)\b)");
    return std::regex_search(text, flag) || std::regex_search(text, command);
}

} // namespace

// What stops the window from coming up is told on the terminal, where it was called.
TEST_CASE("every hint of core and the renderer has a text for the window") {
    int advised = 0;
    for (const char* const folder :
         {"core", "render/renderer", "render/gpu", "render/scene", "app/storage", "app/workspace"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(RAMUS_SOURCE_DIR) / folder)) {
            if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
            for (const std::string& literal : literals_of(entry.path())) {
                if (!of_command_line(literal)) continue;
                ++advised;
                CAPTURE(entry.path().filename().string());
                CAPTURE(literal);
                const std::string words = window_words(literal);
                CAPTURE(words);
                CHECK_FALSE(of_command_line(words));
                CHECK(words.find('`') == std::string::npos);
                CHECK(words.find("a the ") == std::string::npos);
                CHECK(words.find("coarser the") == std::string::npos);
            }
        }
    CHECK(advised > 40);
}
