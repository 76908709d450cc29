#include "app/workspace/volume_facts.h"
#include "tests/support/nifti_file.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

// 4 x 3 x 2 voxels of 2 x 3 x 5 mm, with these values.
std::filesystem::path small_volume(const TemporaryFolder& folder, const std::vector<std::uint8_t>& values) {
    test::NiftiFile file;
    file.dim = {3, 4, 3, 2, 1, 1, 1, 1};
    file.rows = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 5, 0};
    file.put(values);
    return test::write_plain(folder.path() / "mask.nii", file.bytes());
}

} // namespace

TEST_CASE("what a mask holds: its size, its spacing, and how much each label has") {
    const TemporaryFolder folder;
    std::vector<std::uint8_t> values(24, 0);
    values[0] = values[1] = values[2] = 1;
    values[20] = 7;
    Job job;
    const auto facts = read_volume_facts(small_volume(folder, values), {}, 0.0, job);
    REQUIRE(facts);
    CHECK(facts->mask);
    CHECK(facts->size == glm::ivec3(4, 3, 2));
    CHECK(facts->spacing_mm.z == doctest::Approx(5.0));
    REQUIRE(facts->labels.size() == 2);
    CHECK(facts->labels[0].label == 1);
    CHECK(facts->labels[0].voxels == 3);
    CHECK(facts->labels[0].volume_mm3 == doctest::Approx(3 * 2.0 * 3.0 * 5.0)); // voxels of 30 mm3
    CHECK(facts->labels[1].label == 7);
    CHECK(words_for(*facts) == "A mask with 2 labels");
}

TEST_CASE("a file that is no volume is an error, not facts") {
    const TemporaryFolder folder;
    Job job;
    CHECK_FALSE(read_volume_facts(folder.path() / "missing.nii", {}, 0.0, job));
    CHECK_FALSE(read_volume_facts(test::write_plain(folder.path() / "junk.nii", "junk"), {}, 0.0, job));
}
