#include "app/reports/report_page.h"
#include "app/reports/report_tables.h"
#include "core/io/binary_numbers.h"
#include "core/io/trees/swc.h"
#include "tests/support/command_stage.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

constexpr const char* kTree = "# id type x y z radius parent (mm, RAS)\n1 0 0 0 0 3 -1\n2 0 0 0 10 3 1\n3 0 1 0 10 2 "
                              "2\n4 0 8 0 10 2 3\n5 0 0 1 10 1 2\n6 0 0 6 10 1 5\n";

struct Stage : test::CommandStage {
    TemporaryFolder folder;
    Stage() : CommandStage(*io::parse_tree(kTree, "tree.swc"), session()) {}
    static Session session() {
        Session s;
        s.tree.path = "/data/<tree> & \"co\".swc";
        s.tree.checksum = "abc123";
        return s;
    }
    [[nodiscard]] std::string file(const std::string& name) const {
        return "\"" + (folder.path() / name).string() + "\"";
    }
};

// RFC 4180, read strictly.
std::vector<std::vector<std::string>> parsed(const std::string& text) {
    std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        std::string& field = rows.back().back();
        if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
            field += '"';
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (!quoted && c == ',') {
            rows.back().emplace_back();
        } else if (!quoted && c == '\r') {
            REQUIRE(text.at(++i) == '\n');
            rows.emplace_back(1, "");
        } else {
            CHECK((quoted || c != '\n'));
            field += c;
        }
    }
    CHECK_FALSE(quoted);
    REQUIRE(rows.back() == std::vector<std::string>{""}); // the last line ends too
    rows.pop_back();
    for (const auto& row : rows) CHECK(row.size() == rows.front().size());
    return rows;
}

} // namespace

TEST_CASE("CSV fields are quoted where they must be and nowhere else") {
    CHECK(csv_field("plain words") == "plain words");
    CHECK(csv_field("a,b") == "\"a,b\"");
    CHECK(csv_field("the \"left\" one") == "\"the \"\"left\"\" one\"");
    CHECK(csv_field("two\nlines") == "\"two\nlines\"");
    CHECK(csv_field("") == "");
}

TEST_CASE("base64 follows RFC 4648") {
    for (const auto& [bytes, text] :
         {std::pair{"", ""}, std::pair{"f", "Zg=="}, std::pair{"fo", "Zm8="}, std::pair{"foo", "Zm9v"},
          std::pair{"foob", "Zm9vYg=="}, std::pair{"fooba", "Zm9vYmE="}, std::pair{"foobar", "Zm9vYmFy"}})
        CHECK(io::base64_encoded(bytes) == text);
    CHECK(io::base64_encoded("\xFF\xFE\xFD") == "//79");
}

TEST_CASE("CSV reports contain the tables, also with special characters in names") {
    Stage stage;
    CHECK(stage.bad("report " + stage.file("r.csv")).find("nothing to report") != std::string::npos);
    stage.good("name 1 \"segment V, \\\"upper\\\"\"\nselect 0 1\nreport " + stage.file("s.csv"));
    auto rows = parsed(stage.folder.text("s.csv"));
    REQUIRE(rows.size() == 3);
    CHECK(rows[0][0] == "branch");
    CHECK(rows[0][2] == "mean_diameter");
    CHECK(rows[1][0] == "0");
    CHECK(rows[1][2] == "6");
    CHECK(rows[1][10] == "2"); // depend on it
    CHECK(rows[2][1] == "segment V, \"upper\"");

    stage.good("cut 0 0.5\ncut 1 0.25\nreport " + stage.file("c.csv")); // cuts go first
    rows = parsed(stage.folder.text("c.csv"));
    REQUIRE(rows.size() == 4);
    CHECK(rows[1][5] == "yes");
    CHECK(rows[2][5] == "no");
    CHECK(rows[2][7] == "6");
    CHECK(rows[3][0] == "all");
    CHECK(rows[3][7] == "19"); // 5 + 8 + 6, nothing twice

    stage.good("lesion 8,10,10,2\nreport " + stage.file("b.csv") + " bands\nreport " + stage.file("s2.csv") +
               " selection");
    rows = parsed(stage.folder.text("b.csv"));
    REQUIRE(rows.size() == 4);
    CHECK(rows[0][5] == "lesion_distance");
    const auto wide = parsed(stage.folder.text("s2.csv"));
    CHECK(wide[0][wide[0].size() - 2] == "lesion_distance");
    CHECK(wide[0].back() == "unit");
    CHECK(wide[1].back() == "mm");
    stage.good("measure path 1 2\nreport " + stage.file("m.csv") + " measurements");
    rows = parsed(stage.folder.text("m.csv"));
    CHECK(rows[1][3] == "7");

    stage.bad("report " + stage.file("x.csv") + " everything");
    stage.bad("report " + stage.file("x.txt"));
    stage.bad("report " + stage.file("x.html") + " cuts");
    stage.bad("report " + stage.file("missing/x.csv"));
    stage.bad("report " + stage.file("missing/x.html"));
    CHECK(std::ranges::none_of(stage.folder.names(), [](const std::string& n) { return n.starts_with("x."); }));
}

TEST_CASE("the report page is self-contained, and shows user input as text") {
    Stage stage;
    stage.good(
        "name 1 \"<script>alert('x')</script>\"\nselect-generation 0 9\ncut 0\nlesion 8,10,10,2\nmeasure angle 1\n"
        "report " +
        stage.file("r.html"));
    const std::string page = stage.folder.text("r.html");
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK(page.find("<script>") == std::string::npos);
    CHECK(page.find("&lt;script&gt;alert(&#39;x&#39;)") != std::string::npos);
    CHECK(page.find("&lt;tree&gt; &amp; &quot;co&quot;.swc") != std::string::npos);
    CHECK(page.find("abc123") != std::string::npos);
    CHECK(page.find("data:image/png;base64,iVBORw0KGgo") != std::string::npos);
    CHECK(page.find("://") == std::string::npos); // nothing from elsewhere
    for (const char* title : {"Cuts", "Margins around lesions", "Lesions", "Measurements", "Selection", "Options"})
        CHECK_MESSAGE(page.find("<h2>" + std::string(title)) != std::string::npos, title);
    CHECK(page.find("1 vessel that is cut is over 5.00 mm wide") != std::string::npos);
    REQUIRE(stage.host.cameras.size() == 1); // without a mesh there is but the current view
    CHECK(stage.host.cameras[0] == stage.document.session().camera);
    CHECK(stage.host.sizes[0] == glm::ivec2(1200, 900)); // in the shape of the picture, 400 x 300
    CHECK(stage.host.looks[0].ground == Ground::kWhite);
    CHECK(page.find("class=\"case\"") == std::string::npos);
}

TEST_CASE("a page shows the case line as text, and the document does not store it") {
    Stage stage;
    const Marks before = stage.marks();
    stage.good("report " + stage.file("r.html") + " --case \"A <b> & C\" --size 50x100");
    const std::string page = stage.folder.text("r.html");
    CHECK(page.find("<p class=\"case\">A &lt;b&gt; &amp; C</p>") != std::string::npos);
    CHECK(page.find("A &lt;b&gt;") > page.find("<h1>")); // not in the title
    CHECK(stage.host.sizes[0] == glm::ivec2(600, 1200));
    CHECK(stage.marks() == before);
    stage.bad("report " + stage.file("r.html") + " --case");
    stage.bad("report " + stage.file("r.html") + " --size 0x0");
    CHECK(stage.bad("report " + stage.file("r.csv") + " --case x").find("page") != std::string::npos);
}

TEST_CASE("volumes of a column are in ml if one of them reaches a millilitre") {
    const auto table = [](double volume, const char* unit) {
        return in_words({"Volumes",
                         {{"volume", "Lost volume, mm\xC2\xB3"}, {"length", "Length, mm"}, unit_column()},
                         {{volume, 2000.0, unit}, {500.0, 1.0, unit}, {"", 1.0, unit}}});
    };
    const Table large = table(17800.0, "mm");
    CHECK(large.columns[0].heading == "Lost volume, ml");
    CHECK(*large.rows[0][0].number == doctest::Approx(17.8));
    CHECK(*large.rows[1][0].number == doctest::Approx(0.5));
    CHECK_FALSE(large.rows[2][0].number);
    CHECK(*large.rows[0][1].number == 2000.0);
    CHECK(table(999.0, "mm").columns[0].heading == "Lost volume, mm\xC2\xB3");
    CHECK(*table(17800.0, "unknown").rows[0][0].number == 17800.0);
    CHECK(table(17800.0, "unknown").columns[0].heading.find("ml") == std::string::npos);
}
