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

TEST_CASE("the facts of a mask are its size, its spacing and the volume of each label") {
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

TEST_CASE("a scan has a threshold curve, a mask has labels, and a volume that may be either has both") {
    const TemporaryFolder folder;
    Job job;
    // 12 x 12 x 4 voxels of 0.5 mm, whose values run through so many whole numbers from `first` on.
    const auto facts_of = [&](int first, int different) {
        test::NiftiFile file;
        file.dim = {3, 12, 12, 4, 1, 1, 1, 1};
        file.type = static_cast<int>(test::NiftiType::kInt16);
        file.rows = {0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0};
        std::vector<std::int16_t> values;
        for (int n = 0; n < 12 * 12 * 4; ++n) values.push_back(static_cast<std::int16_t>(first + n % different));
        file.put(values);
        auto facts = read_volume_facts(test::write_plain(folder.path() / "v.nii", file.bytes()), {}, 0.0, job);
        REQUIRE(facts);
        return std::move(*facts);
    };
    const VolumeFacts ct = facts_of(-200, 500);
    CHECK_FALSE(ct.mask);
    CHECK(ct.labels.empty());
    REQUIRE(ct.curve);
    CHECK(ct.curve->voxels.front() == 12 * 12 * 4);
    CHECK(ct.voxel_mm3 == doctest::Approx(0.125));
    CHECK(words_for(ct) == "A scan, values from -200 to 299");
    const VolumeFacts organs = facts_of(0, 118); // labels of a whole body
    CHECK(organs.mask);
    CHECK(organs.labels.size() == 117);
    CHECK(organs.may_be_either());
    const VolumeFacts bytes = facts_of(0, 250); // a scan of 8 bits
    CHECK_FALSE(bytes.mask);
    CHECK(bytes.may_be_either());
    const VolumeFacts labels = facts_of(998, 5); // as programs number what they know
    CHECK(labels.mask);
    CHECK_FALSE(labels.curve);
    CHECK_FALSE(labels.all_at_once);
    CHECK(labels.labels.size() == 5);
    job.cancel();
    CHECK_FALSE(read_volume_facts(folder.path() / "v.nii", {}, 0.0, job));
}

TEST_CASE("a file that is not a volume gives an error") {
    const TemporaryFolder folder;
    Job job;
    CHECK_FALSE(read_volume_facts(folder.path() / "missing.nii", {}, 0.0, job));
    CHECK_FALSE(read_volume_facts(test::write_plain(folder.path() / "junk.nii", "junk"), {}, 0.0, job));
}
