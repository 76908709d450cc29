#include "app/session/window_words.h"

#include <doctest/doctest.h>
#include <string>

using namespace ramus::app;

TEST_CASE("advice in a window names no flag and no command line") {
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
