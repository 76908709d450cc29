// Reading and storing run at the same time: what happens when one of them stops.
#include "core/io/volumes/byte_stage.h"
#include "core/io/volumes/voxel_data.h"

#include <algorithm>
#include <cstring>
#include <doctest/doctest.h>
#include <functional>
#include <limits>
#include <utility>

using namespace ramus;

namespace {

constexpr std::size_t kMib = std::size_t{1} << 20;

// Endless numbers 0, 1, 2 ... of 4 bytes. `at_byte` is called with the number of bytes so far; it may change the next
// number or end the stream.
struct Numbers : io::ByteStage {
    std::size_t& given;
    std::function<Result<void>(std::size_t, float&)> at_byte;
    Numbers(std::size_t& count, std::function<Result<void>(std::size_t, float&)> call)
        : given(count), at_byte(std::move(call)) {}
    Result<std::size_t> read(char* into, std::size_t bytes) override {
        const std::size_t whole = bytes / sizeof(float) * sizeof(float);
        for (std::size_t n = 0; n < whole; n += sizeof(float), given += sizeof(float)) {
            auto number = static_cast<float>(given / sizeof(float) % 5000);
            if (auto on = at_byte(given, number); !on) return tl::unexpected(on.error());
            std::memcpy(into + n, &number, sizeof number);
        }
        return whole;
    }
};

struct Outcome {
    Result<volume::Volume> volume;
    std::size_t given = 0;
    float progress = 0.0F;
};

Outcome read_numbers(std::function<Result<void>(std::size_t, float&)> at_byte, Job& job) {
    std::size_t given = 0;
    auto source = io::ByteSource::of_stage(std::make_unique<Numbers>(given, std::move(at_byte)), "numbers", 1e12);
    REQUIRE(source);
    io::VoxelLayout layout{.size = {1024, 1024, 25}, .type = io::VoxelType::kFloat32, .scaling = {}}; // 100 MiB
    auto volume = io::read_voxels(*source, 0, layout, {1e9}, job);
    return {std::move(volume), given, job.progress()};
}

} // namespace

TEST_CASE("numbers are stored in their order, and progress reaches the end") {
    Job job;
    const Outcome whole = read_numbers([](std::size_t, float&) { return Result<void>{}; }, job);
    REQUIRE(whole.volume);
    for (int n = 0; n < 1024 * 1024 * 25; n += 1013)
        if (volume::value_at(*whole.volume, {n % 1024, n / 1024 % 1024, n / 1024 / 1024}) != n % 5000)
            FAIL("voxel " << n);
    CHECK(whole.progress == 1.0F);
}

TEST_CASE("reading stops soon after it is cancelled, and after an error of either side") {
    constexpr std::size_t kThere = 20 * kMib, kSoon = 4 * kMib;
    Job cancelled;
    Outcome outcome = read_numbers(
        [&](std::size_t byte, float&) {
            if (byte == kThere) cancelled.cancel();
            return Result<void>{};
        },
        cancelled);
    REQUIRE_FALSE(outcome.volume);
    CHECK(outcome.volume.error().what == "cancelled");
    CHECK(outcome.given <= kThere + kSoon);
    Job job;
    outcome = read_numbers(
        [](std::size_t byte, float&) -> Result<void> {
            if (byte == kThere) return fail("the medium failed");
            return {};
        },
        job);
    REQUIRE_FALSE(outcome.volume);
    CHECK(outcome.volume.error().what == "the medium failed");
    outcome = read_numbers(
        [](std::size_t byte, float& number) {
            if (byte == kThere) number = std::numeric_limits<float>::infinity();
            return Result<void>{};
        },
        job);
    REQUIRE_FALSE(outcome.volume);
    CHECK(outcome.volume.error().what == "the value of voxel (0, 0, 5) is not finite");
    CHECK(outcome.given <= kThere + kSoon);
}
