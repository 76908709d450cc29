// What lasts: a thousand trees opened and closed, pictures of any size in a row, memory that runs out and comes back.
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_mesh.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fstream>
#include <malloc.h>
#include <string>
#include <unistd.h>
#include <vector>

using namespace ramus::render;
using ramus::test::WatchedContext;

#ifdef __SANITIZE_ADDRESS__
// Of the sanitizer's allocator_interface.h, which gcc does not install.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes(); // NOLINT(bugprone-reserved-identifier)
#endif

namespace {

constexpr GlVersion kFull{4, 5}, kFloor{3, 3};

// Another tree for each number: opaque, glass and a selection.
Frame tree_to_turn(int number, glm::ivec2 size = {64, 48}) {
    ramus::mesh::TriangleMesh mesh;
    const float turn = 0.1F * static_cast<float>(number % 60);
    ramus::test::add_capsule(mesh, {0, 0, -30}, {turn, 0, 10}, 5.0F, 4.0F, 0);
    ramus::test::add_capsule(mesh, {turn, 0, 10}, {-25, turn, 30}, 3.5F, 2.0F, 1);
    Frame frame;
    frame.mesh = std::make_shared<const PagedMesh>(mesh);
    auto lines = std::make_shared<Centerlines>();
    lines->runs = {{0, 2}, {2, 2}};
    for (const glm::vec3& at :
         {glm::vec3(0, 0, -30), glm::vec3(turn, 0, 10), glm::vec3(turn, 0, 10), glm::vec3(-25, turn, 30)})
        lines->points.emplace_back(at, 0.0F),
            lines->details.push_back({8.0F, static_cast<int>(lines->points.size() - 1) / 2});
    frame.centerlines = lines;
    frame.size = size;
    frame.camera = camera_for(frame.mesh->positions(), View::kAnterior, size);
    frame.states = {BranchState::kNormal, BranchState::kDefocused};
    frame.selected = {0};
    return frame;
}

// Of the process, in bytes, resident, without what is free for the next allocation. The address sanitizer keeps what is
// freed for long, to catch its use, and spreads allocations over its heap: what is resident grows by 20 MB while what
// is allocated stays the same, so there it is the latter that counts.
std::size_t memory() {
#ifdef __SANITIZE_ADDRESS__
    return __sanitizer_get_current_allocated_bytes();
#else
    malloc_trim(0);
    std::size_t pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
#endif
}

// GL's own word for what is alive, of the first names.
int objects_in_gl() {
    int count = 0;
    for (GLuint id = 1; id < 20000; ++id)
        count += (glIsBuffer(id) | glIsTexture(id) | glIsFramebuffer(id) | glIsVertexArray(id) | glIsProgram(id) |
                  glIsShader(id) | glIsQuery(id)) != GL_FALSE
                     ? 1
                     : 0;
    return count;
}

constexpr int kCycles = 1000, kWarmUp = 100, kWindow = 200, kEvery = 10;
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kGrowth = std::size_t{256} << 10; // from window to window: 370 bytes a cycle
#else
constexpr std::size_t kGrowth = std::size_t{2} << 20; // 3 kB a cycle
#endif

// llvmpipe lets go of 16 MiB of a context's when its threads get to it, which some looks at the memory have and others
// do not. What leaks raises the least, the middle and the most of many looks alike.
template <class Cycle> void check_flat(const char* what, const Cycle& cycle) {
    std::vector<std::size_t> early, late;
    for (int i = 0; i < kCycles; ++i) {
        cycle(i);
        if (i % kEvery != 0) continue;
        if (i >= kWarmUp && i < kWarmUp + kWindow) early.push_back(memory());
        if (i >= kCycles - kWindow) late.push_back(memory());
    }
    std::ranges::sort(early);
    std::ranges::sort(late);
    const auto grown = [&](std::size_t look) { return static_cast<long>(late[look]) - static_cast<long>(early[look]); };
    const long growth = std::min({grown(0), grown(early.size() / 2), grown(early.size() - 1)});
#ifndef __SANITIZE_THREAD__ // that keeps its own notes on machine code that Mesa made and let go
    CHECK(growth < static_cast<long>(kGrowth));
#endif
    MESSAGE(std::string(what), ": ", growth / 1024, " KiB more in the last ", kWindow, " of ", kCycles,
            " cycles than in those after ", kWarmUp);
}

} // namespace

TEST_CASE("a thousand trees opened and closed leave nothing behind" * doctest::test_suite("slow")) {
    for (const GlVersion version : {kFull, kFloor}) {
        CAPTURE(version.text());
        const WatchedContext context(version);
        REQUIRE(gl_objects_alive() == 0);
        {
            const auto renderer = Renderer::create();
            REQUIRE(renderer);
            check_flat("one renderer, another tree each time", [&](int i) {
                REQUIRE((*renderer)->draw(tree_to_turn(i)));
                (void)(*renderer)->refine(i % 2 == 0 ? kUntilDone : 0.0); // to its end, or left in the middle
            });
        }
        CHECK(gl_objects_alive() == 0);
        CHECK(objects_in_gl() == 0);
    }
}

TEST_CASE("a thousand renderers made and gone leave nothing behind" * doctest::test_suite("slow")) {
    const WatchedContext context;
    check_flat("a renderer each time", [&](int i) {
        const auto renderer = Renderer::create();
        REQUIRE(renderer);
        REQUIRE((*renderer)->draw(tree_to_turn(i)));
    });
    CHECK(gl_objects_alive() == 0);
    CHECK(objects_in_gl() == 0);
}

TEST_CASE("a picture shrinks to one pixel, to none, and comes back" * doctest::test_suite("slow")) {
    for (const GlVersion version : {kFull, kFloor}) {
        const WatchedContext context(version);
        const auto renderer = Renderer::create();
        REQUIRE(renderer);
        Frame frame = tree_to_turn(3, {200, 150});
        const auto draw = [&](glm::ivec2 size) {
            frame.size = size;
            return (*renderer)->draw(frame);
        };
        REQUIRE(draw({200, 150}));
        const Image before = (*renderer)->read_image();
        REQUIRE(draw({1, 1}));
        CHECK((*renderer)->refine()->changed);
        CHECK((*renderer)->read_image().width == 1);
        for (const glm::ivec2 none : {glm::ivec2(0, 0), glm::ivec2(0, 150), glm::ivec2(200, 0)}) {
            const auto refused = draw(none);
            REQUIRE_FALSE(refused.has_value());
            CHECK(refused.error().message().find("no pixels") != std::string::npos);
        }
        REQUIRE(draw({1, 150}));
        REQUIRE(draw({200, 150}));
        CHECK((*renderer)->read_image() == before);
    }
}

TEST_CASE("a renderer that memory is not enough for says so") {
    for (const GlVersion version : {kFull, kFloor}) {
        CAPTURE(version.text());
        const WatchedContext context(version);
        limit_gl_allocation(16);
        const auto refused = Renderer::create();
        limit_gl_allocation();
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().message().find("out of graphics memory") != std::string::npos);
        CHECK(Renderer::create().has_value());
    }
    CHECK(gl_objects_alive() == 0);
}

TEST_CASE("where graphics memory runs out a message says so, and drawing goes on" * doctest::test_suite("slow")) {
    for (const GlVersion version : {kFull, kFloor}) {
        CAPTURE(version.text());
        const WatchedContext context(version);
        const Frame frame = tree_to_turn(3, {200, 150});
        auto renderer = Renderer::create();
        REQUIRE(renderer);
        REQUIRE((*renderer)->draw(frame));
        const Image expected = (*renderer)->read_image();
        // From the smallest allocation to the largest: another one fails each time.
        int failures = 0;
        for (std::size_t limit = 64; limit < (std::size_t{64} << 20); limit *= 2) {
            CAPTURE(limit);
            auto other = Renderer::create();
            REQUIRE(other);
            limit_gl_allocation(limit);
            const auto refused = (*other)->draw(frame);
            (*other)->request_pick(100, 75);
            (void)(*other)->poll_pick();
            (void)(*other)->read_image();
            limit_gl_allocation();
            if (!refused) {
                ++failures;
                CHECK(refused.error().message().find("out of graphics memory") != std::string::npos);
                CHECK_FALSE(refused.error().hint.empty());
            }
            const auto again = (*other)->draw(frame);
            REQUIRE_MESSAGE(again.has_value(), (again ? "" : again.error().message()));
            CHECK((*other)->read_image() == expected);
        }
        CHECK(failures > 8);
        // A picture that is there, and then a larger one that does not fit.
        limit_gl_allocation(std::size_t{1} << 20);
        Frame larger = frame;
        larger.size = {1000, 800};
        CHECK_FALSE((*renderer)->draw(larger).has_value());
        limit_gl_allocation();
        REQUIRE((*renderer)->draw(frame));
        CHECK((*renderer)->read_image() == expected);
    }
    CHECK(gl_objects_alive() == 0);
}

TEST_CASE("memory that the driver really does not have is reported, and it draws on") {
    const WatchedContext context;
    if (!is_software_rasteriser()) return; // a card might have it
    // 64 GiB.
    CHECK_THROWS_AS((void)make_texture(GL_RGBA32F, 16384, 16384, 4), OutOfGraphicsMemory);
    CHECK_THROWS_AS((void)make_buffer(std::size_t{1} << 46, nullptr), OutOfGraphicsMemory);
    CHECK_FALSE(gl_ran_out_of_memory()); // it has been told
    CHECK(gl_objects_alive() == 0);
    const auto renderer = Renderer::create();
    REQUIRE(renderer);
    CHECK((*renderer)->draw(tree_to_turn(1)).has_value());
}
