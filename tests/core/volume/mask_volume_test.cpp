// Runs of rows of a mask, and masks as volumes, against the voxels themselves.
#include "core/volume/mask_volume.h"

#include <doctest/doctest.h>
#include <random>

using namespace ramus;

namespace {

volume::SparseMask random_mask(const glm::ivec3& size, double share, volume::SparseMask::Words stored) {
    std::mt19937 random(5);
    std::bernoulli_distribution inside(share);
    volume::BitMask bits(size);
    bool value = false;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                if (random() % 5 == 0) value = inside(random); // runs
                if (value) bits.set({i, j, k});
            }
    volume::SparseMask::Builder builder(size);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (std::size_t w = 0; w < bits.row_words(); ++w)
                builder.add(w + bits.row_words() * static_cast<std::size_t>(j + size.y * k), bits.row(j, k)[w]);
    return std::move(builder).finish(stored);
}

} // namespace

TEST_CASE("a mask and its volume have the same voxels inside") {
    using Words = volume::SparseMask::Words;
    for (const glm::ivec3& size : {glm::ivec3(1, 3, 2), glm::ivec3(63, 5, 4), glm::ivec3(64, 5, 4),
                                   glm::ivec3(65, 40, 30), glm::ivec3(130, 17, 70)})
        for (const double share : {0.0, 0.03, 0.5, 1.0})
            for (const Words stored : {Words::kAllIfFew, Words::kFilled}) {
                const volume::SparseMask mask = random_mask(size, share, stored);
                volume::Volume like;
                like.to_patient[3] = {4.0, 5.0, 6.0, 1.0};
                like.unit_mm = 1.0;
                const volume::Volume made = volume::mask_volume(mask, like);
                REQUIRE(made.size == size);
                CHECK(made.to_patient == like.to_patient);
                CHECK(made.unit_mm == like.unit_mm);
                CHECK(volume::looks_like_a_mask(made));
                std::size_t different = 0;
                for (int k = 0; k < size.z; ++k)
                    for (int j = 0; j < size.y; ++j) {
                        std::vector<char> of_runs(static_cast<std::size_t>(size.x), 0);
                        volume::for_row_runs(mask, j, k, [&](int first, int end) {
                            for (int i = first; i < end; ++i) of_runs.at(static_cast<std::size_t>(i)) += 1;
                        });
                        for (int i = 0; i < size.x; ++i) {
                            const bool inside = mask.test({i, j, k});
                            different += (volume::value_at(made, {i, j, k}) != 0.0) != inside;
                            different += of_runs[static_cast<std::size_t>(i)] != static_cast<char>(inside);
                        }
                    }
                CHECK(different == 0);
            }
}
