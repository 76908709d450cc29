#include "core/base/printable.h"

#include <doctest/doctest.h>

using namespace ramus;

TEST_CASE("what steers a terminal is spelled, and words are left alone") {
    CHECK(printable("V. portae, H\xC3\xB6he 3 \xE2\x89\xA4 5, \xE8\x82\x9D, \xF0\x9F\xA9\xB8") ==
          "V. portae, H\xC3\xB6he 3 \xE2\x89\xA4 5, \xE8\x82\x9D, \xF0\x9F\xA9\xB8");
    CHECK(printable("\x1b[2J\x07\x7f") == "\\u001b[2J\\u0007\\u007f");
    CHECK(printable("a\r\nb\tc") == "a\\u000d\\u000ab\\u0009c");
    CHECK(printable("\xC2\x9B"
                    "2J") == "\\u009b2J"); // CSI in two bytes
    CHECK(printable("\x9B"
                    "2J") == "\\u009b2J");                           // in one
    CHECK(printable("\xE2\x1b[m\xC3") == "\\u00e2\\u001b[m\\u00c3"); // cut short
    CHECK(printable(std::string_view("\0", 1)) == "\\u0000");
    CHECK(printable(printable("\x1b")) == printable("\x1b"));
    CHECK(printable_lines("a\n\tb\r\x1b") == "a\n\tb\\u000d\\u001b");
}
