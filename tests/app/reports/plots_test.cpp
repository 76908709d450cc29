#include "app/reports/html.h"
#include "app/reports/plots/axis.h"
#include "app/reports/plots/distance_plots.h"
#include "app/reports/plots/radius_plot.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <pugixml.hpp>
#include <random>

using namespace ramus;
using namespace ramus::app;

namespace {

pugi::xml_document parsed_svg(const Svg& svg) {
    pugi::xml_document document;
    const auto result = document.load_string(svg.file().c_str());
    CHECK_MESSAGE(result, result.description());
    CHECK(std::string(document.document_element().name()) == "svg");
    return document;
}

std::vector<std::string> words_of(const pugi::xml_document& document) {
    std::vector<std::string> words;
    for (const auto& found : document.select_nodes("//text")) words.emplace_back(found.node().text().get());
    return words;
}

bool has(const std::vector<std::string>& words, const std::string& word) {
    return std::ranges::find(words, word) != words.end();
}

measure::DeviationStatistics statistics_of(std::vector<double> values) {
    return measure::statistics_of(values, std::nullopt);
}

} // namespace

TEST_CASE("ticks are 1, 2 or 5 times a power of ten apart, inside the range, and neither few nor many") {
    CHECK(round_numbers(0.0, 1.0) == std::vector<double>{0.0, 0.2, 0.4, 3 * 0.2, 0.8, 1.0});
    CHECK(round_numbers(0.0, 0.4).size() == 5); // 0, 0.1, ..., 0.4
    CHECK(round_numbers(-2.0, 2.0) == std::vector<double>{-2.0, -1.0, 0.0, 1.0, 2.0});
    CHECK(round_numbers(3.0, 3.0) == std::vector<double>{3.0});
    CHECK(round_numbers(0.5, 20.0, true) == std::vector<double>{0.5, 1.0, 2.0, 5.0, 10.0, 20.0});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> power(-9.0, 6.0), part(0.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const double size = std::pow(10.0, power(random)), low = (part(random) - 0.5) * 3.0 * size;
        const double high = low + size;
        const std::vector<double> found = round_numbers(low, high);
        CAPTURE(low);
        CAPTURE(high);
        // A step is at least a fifth of the way, and less than half of it (2 to 5, 5 to 10).
        CHECK(found.size() >= 2);
        CHECK(found.size() <= 6);
        CHECK(found.front() >= low - 1e-8 * size);
        CHECK(found.back() <= high + 1e-8 * size);
        for (std::size_t n = 1; n < found.size(); ++n) {
            const double step = found[n] - found[n - 1];
            const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
            const auto is = [&](double whole) { return std::abs(digit - whole) < 1e-4; };
            CHECK((is(1.0) || is(2.0) || is(5.0)));
        }
    }
}

TEST_CASE("ticks have no more digits than needed") {
    CHECK(tick_text(0.0) == "0");
    CHECK(tick_text(3 * 0.1) == "0.3");
    CHECK(tick_text(250.0) == "250");
    CHECK(tick_text(-0.05) == "-0.05");
    CHECK(tick_text(1e-4) == "0.0001");
}

TEST_CASE("axes go from end to end, linear and logarithmic") {
    const Axis linear = linear_axis(0.0, 0.4);
    CHECK(linear.share(0.1) == doctest::Approx(0.25));
    const Axis powers = logarithmic_axis(0.003, 100.0);
    CHECK(powers.low == doctest::Approx(0.001));
    CHECK(powers.ticks.size() == 6);
    CHECK(powers.share(0.1) == doctest::Approx(0.4)); // two of five powers
    CHECK(logarithmic_axis(1e-12, 1.0).ticks.size() <= 7);
    CHECK(linear_axis(0.0, 0.0).share(0.0) == 0.0); // all distances may be 0
}

TEST_CASE("drawings are valid XML for any text") {
    const std::string name = "<b>&\"'.swc\x01\xFF";
    const auto statistics = statistics_of({0.0, 0.1, 0.2, 0.3, 0.4});
    const auto boxes = parsed_svg(box_plots("Surface to <cones>", {{name, &statistics, 0.25}}, kConesStroke, "half"));
    CHECK(has(words_of(boxes), "<b>&\"'.swc\xEF\xBF\xBD\xEF\xBF\xBD"));
    CHECK(has(words_of(boxes), "Distance, mm"));
    CHECK(has(words_of(boxes), "half"));
    CHECK(std::string(boxes.document_element().attribute("aria-label").value()) == "Surface to <cones>");
}

TEST_CASE("a histogram has one bar for each bin that is not empty, on an axis in percent") {
    const auto statistics = statistics_of({0.0, 0.0, 0.0, 1.0});
    const auto plot = parsed_svg(histogram_plot("Distances", statistics, kMaskStroke, std::nullopt, ""));
    CHECK(plot.select_nodes("//rect").size() == 2);
    CHECK(has(words_of(plot), "Share of vertices, %"));
    CHECK(has(words_of(plot), "100"));
    parsed_svg(histogram_plot("Nothing", statistics_of({0.0, 0.0}), kMaskStroke, 0.5, "half"));
}

TEST_CASE("curves of radii are clipped at the top of the plot, and also differ by dashes") {
    RadiusCurves curves;
    for (int i = 0; i <= 10; ++i) {
        curves.along_mm.push_back(i);
        curves.input_mm.push_back(1.0);
        curves.surface_mm.push_back(i == 5 ? 9.0 : 1.01); // where another vessel joins it
        curves.cones_mm.push_back(0.99);
        curves.alone.push_back(i != 5);
    }
    const auto plot = parsed_svg(radius_plot("Branch 7", curves));
    CHECK(plot.select_nodes("//polyline").size() == 4); // the surface's in two parts
    CHECK(plot.select_nodes("//polyline[@stroke-dasharray]").size() == 1);
    CHECK(plot.select_nodes("//rect").size() == 1); // not alone
    for (const char* words : {"read", "surface", "truncated cones", "Radius, mm", "Along the branch, mm"})
        CHECK(has(words_of(plot), words));
    CHECK_FALSE(has(words_of(plot), "mask"));
    for (const auto& found : plot.select_nodes("//polyline"))
        CHECK(std::string(found.node().attribute("points").value()).find("nan") == std::string::npos);
}

TEST_CASE("long words are shortened in the middle, letter by letter") {
    CHECK(shortened("liver.swc", 200.0) == "liver.swc");
    const std::string name = shortened(std::string(50, 'x') + "\xC3\xA4.swc", 100.0);
    CHECK(width_of(name) <= 100.0);
    CHECK(name.ends_with("\xC3\xA4.swc"));
    CHECK(name.find("\xE2\x80\xA6") != std::string::npos);
}

TEST_CASE("text is escaped in pages and drawings") {
    CHECK(html_text("<i>\"&'</i>") == "&lt;i&gt;&quot;&amp;&#39;&lt;/i&gt;");
    CHECK(html_text("\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80") == "\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
    // Not UTF-8: a cut letter, a needlessly long spelling, half of a letter of UTF-16; and control characters.
    for (const char* bytes : {"\xC3", "\x1B", "\xFF"}) CHECK(html_text(bytes) == "\xEF\xBF\xBD");
    CHECK(html_text("\xC0\xAF").find('/') == std::string::npos);
    CHECK(html_text("\xED\xA0\x80") == "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}
