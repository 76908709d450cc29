#include "core/io/orientation.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <set>

using namespace ramus::io;

namespace {

glm::dmat3 matrix_of(const Orientation& orientation) {
    return {orientation.to_patient({1, 0, 0}), orientation.to_patient({0, 1, 0}), orientation.to_patient({0, 0, 1})};
}

} // namespace

TEST_CASE("there are 48 orientations, of which 24 turn and 24 mirror") {
    const std::vector<Orientation> all = all_orientations();
    REQUIRE(all.size() == 48);
    CHECK(all.front() == Orientation::ras());
    std::set<std::string> letters;
    for (const Orientation& one : all) letters.insert(one.letters());
    CHECK(letters.size() == 48);
    // The determinant says it: 1 of a turn, -1 of a mirror image.
    for (const Orientation& one : all) {
        CAPTURE(one.letters());
        CHECK(glm::determinant(matrix_of(one)) == (one.mirrors() ? -1.0 : 1.0));
    }
    CHECK(std::ranges::count_if(all, &Orientation::mirrors) == 24);
    CHECK(std::ranges::is_partitioned(all, [](const Orientation& one) { return !one.mirrors(); }));
}

TEST_CASE("an orientation is undone by its inverse, to the bit, and read back by its letters") {
    const glm::dvec3 place(0.1, -20.7, 1e-3);
    for (const Orientation& one : all_orientations()) {
        CAPTURE(one.letters());
        CHECK(one.to_file(one.to_patient(place)) == place);
        CHECK(one.to_patient(one.to_file(place)) == place);
        CHECK(Orientation::named(one.letters()) == one);
        CHECK(glm::length(one.to_patient(place)) == doctest::Approx(glm::length(place)));
    }
}

TEST_CASE("letters say where each axis leads") {
    CHECK(Orientation::named("RAS")->to_patient({1, 2, 3}) == glm::dvec3(1, 2, 3));
    CHECK(Orientation::named("LPS")->to_patient({1, 2, 3}) == glm::dvec3(-1, -2, 3));
    CHECK(Orientation::named("lps") == Orientation::lps());
    // x to the left alone: the mirror image.
    CHECK(Orientation::named("LAS")->to_patient({1, 2, 3}) == glm::dvec3(-1, 2, 3));
    CHECK(Orientation::named("LAS")->mirrors());
    // x to the back, y down, z to the right: z is the patient's x, x the other way along y, y the other way along z.
    CHECK(Orientation::named("PIR")->to_patient({1, 2, 3}) == glm::dvec3(3, -1, -2));
    CHECK_FALSE(Orientation::named("PIR")->mirrors());
    CHECK(Orientation::named("PIR")->words() == "posterior, inferior, right (PIR)");
}

TEST_CASE("what names no orientation is refused: two axes along one line, too few letters, others") {
    for (const char* text : {"", "R", "RA", "RASS", "RLS", "RRS", "RAA", "RAX", "123", "R S", "axes"})
        CHECK_FALSE(Orientation::named(text));
    CHECK_FALSE(Orientation::leading_to({Side::kRight, Side::kLeft, Side::kSuperior}));
    CHECK(Orientation::leading_to({Side::kInferior, Side::kLeft, Side::kAnterior})->letters() == "ILA");
}
