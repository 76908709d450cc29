#include "app/panels/export_choice.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <string_view>

using namespace ramus;
using namespace ramus::app;
using Words = std::vector<std::string>;

TEST_CASE("the name of an export has the ending of its format") {
    ExportChoice choice;
    choice.follow("x.stl");
    CHECK(choice.format().extension == ".stl");
    CHECK(choice.named("liver") == "liver.stl");
    CHECK(choice.named("liver.stl") == "liver.stl");
    CHECK(choice.named("liver.STL") == "liver.STL");
    CHECK(choice.named("liver.ply") == "liver.stl");       // another format's
    CHECK(choice.named("liver v1.2") == "liver v1.2.stl"); // no format's
    CHECK(choice.named("").empty());
    choice.follow("x.glb");
    CHECK(choice.named("liver.stl") == "liver.glb");
    choice.follow("x.something");
    CHECK(choice.format().extension == ".glb");
}

TEST_CASE("territories get a name of their own") {
    ExportChoice choice;
    choice.follow("x.stl");
    choice.what = ExportWhat::kTerritories;
    CHECK(choice.suggested("liver.nii.gz") == "liver-territories.nii.gz");
    CHECK(choice.suggested("liver-territories.vtp") == "liver-territories.nii.gz");
    CHECK(choice.named("parts.nii.gz") == "parts.nii.gz"); // as it was typed
    choice.what = ExportWhat::kSurface;
    CHECK(choice.suggested("liver-territories.nii.gz") == "liver.stl");
    choice.follow("a.seg.nrrd");
    CHECK(choice.what == ExportWhat::kTerritories);
    CHECK(choice.format().extension == ".seg.nrrd");
}

TEST_CASE("a name chooses kind and format, of two kinds the one that is chosen") {
    ExportChoice choice;
    choice.follow("a.swc");
    CHECK(choice.what == ExportWhat::kTree);
    choice.follow("a.vtp");
    CHECK(choice.what == ExportWhat::kTree);
    CHECK(choice.format().extension == ".vtp");
    choice.follow("a.PNG");
    CHECK(choice.what == ExportWhat::kPicture);
    choice.follow("a.obj");
    CHECK(choice.what == ExportWhat::kSurface);
    choice.follow("a.vtp");
    CHECK(choice.what == ExportWhat::kSurface);
    for (const char* name : {"a.glb", "a.vtp", "a.json", "a.csv", "a.png", "a.Stl"}) CHECK(can_be_export(name));
    for (const char* name : {"a", "a.nii", "a.txt"}) CHECK_FALSE(can_be_export(name));
}

TEST_CASE("an export's command says what means something for its format") {
    ExportChoice choice;
    choice.for_printing = true;
    choice.of = ExportOf::kSelected;
    choice.follow("a.stl");
    CHECK(choice.words("/a.stl") == Words{"surface", "/a.stl", "--of", "selected", "--for-printing"});
    choice.follow("a.glb");
    CHECK(choice.words("/a.glb") == Words{"surface", "/a.glb", "--of", "selected"});
    choice.parts = io::PartsBy::kSystem;
    CHECK(choice.words("/a.glb") == Words{"surface", "/a.glb", "--of", "selected", "--parts", "system"});
    choice.what = ExportWhat::kReport;
    CHECK(choice.words("/a.html") == Words{"report", "/a.html"});
    std::ranges::copy(std::string_view("J. D."), choice.case_line.begin());
    CHECK(choice.words("/a.html") == Words{"report", "/a.html", "--case", "J. D."});
    choice.what = ExportWhat::kPage;
    CHECK(choice.words("/a.html") == Words{"page", "/a.html", "--size-limit", "12"});
    std::ranges::copy(std::string_view("Board"), choice.page.title.begin());
    choice.page.most_mb = 5;
    choice.page.parts.front() = false;
    CHECK(choice.words("/a.html") ==
          Words{"page", "/a.html", "--size-limit", "5", "--title", "Board", "--without", "names"});
    choice.what = ExportWhat::kTable; // trees have that extension too
    choice.follow("a.csv");
    CHECK(choice.words("/a.csv") == Words{"table", "/a.csv", "--of", "selected"});
    choice.follow("a.png");
    CHECK(choice.words("/a.png") == Words{"picture", "/a.png", "--size", "1280x960", "--background", "dark"});
}
