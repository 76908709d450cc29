#include "app/picture/figure_options.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;
using Words = std::vector<std::string>;

TEST_CASE("the options of a picture are written as words and read back without loss") {
    FigureRequest request;
    CHECK(figure_words(request).empty());
    request.size = glm::ivec2(1920, 1080);
    FigureOptions& options = request.options;
    options.ground = Ground::kWhite;
    options.caption = "Liver \"1\", before";
    options.overlays = {"scale", "letters"};
    options.overlays_given = true;
    options.text_size = 1.2;
    options.supersample = 2;
    options.turntable = 36;
    options.frames_a_second = 25;
    options.whole = false;
    FigureRequest read;
    REQUIRE(read_figure_words(figure_words(request), read));
    CHECK(read.size == request.size);
    CHECK(read.options == request.options);
    options.overlays.clear();
    REQUIRE(read_figure_words(figure_words(request), read));
    CHECK(read.options == request.options);
}

TEST_CASE("invalid options of a picture are refused") {
    for (const Words& words : std::vector<Words>{{"--size", "1600"},
                                                 {"--size", "1600x"},
                                                 {"--size", "x1200"},
                                                 {"--size", "0x10"},
                                                 {"--size", "99999x99999"},
                                                 {"--background", "pink"},
                                                 {"--overlays", "cube,clock"},
                                                 {"--text-size", "0"},
                                                 {"--text-size", "nan"},
                                                 {"--supersample", "9"},
                                                 {"--pictures", "1"},
                                                 {"--rate", "0"},
                                                 {"--caption"},
                                                 {"--colour", "red"}}) {
        CAPTURE(words.front());
        FigureRequest request;
        CHECK_FALSE(read_figure_words(words, request));
    }
}
