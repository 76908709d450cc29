// Glass against what geometry says: a ray caster over the same triangles composites the same colours, whatever order
// the triangles come in and however little memory there is for the layers.
#include "render/gl/gl_context.h"
#include "render/renderer/renderer.h"
#include "render/scene/colour.h"
#include "tests/support/beside_scene.h"
#include "tests/support/gl_test.h"
#include "tests/support/tube_mesh.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <random>

using namespace ramus::render;
using ramus::mesh::TriangleMesh;
using ramus::test::add_capsule;
using ramus::test::decoded;
using ramus::test::encoded;
using ramus::test::largest_difference;

namespace {

constexpr int kVessels = 9; // every third one is opaque

// Vessels that cross before and behind each other, and one within another.
TriangleMesh crossing_vessels() {
    TriangleMesh mesh;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> coordinate(-25.0F, 25.0F), radius(2.0F, 7.0F);
    for (int i = 0; i < kVessels - 1; ++i)
        add_capsule(mesh, {coordinate(random), coordinate(random), coordinate(random)},
                    {coordinate(random), coordinate(random), coordinate(random)}, radius(random), radius(random), i,
                    48);
    const auto begin = mesh.positions[0], end = mesh.positions[mesh.positions.size() / 2];
    add_capsule(mesh, begin, end, 9.0F, 9.0F, kVessels - 1, 48);
    return mesh;
}

BranchState state_of(int branch) { return branch % 3 == 2 ? BranchState::kNormal : BranchState::kDefocused; }

struct GlassScene {
    TriangleMesh mesh = crossing_vessels();
    ramus::test::WatchedContext context;
    std::unique_ptr<Renderer> renderer;
    Frame frame;

    explicit GlassScene(bool orthographic, std::size_t glass_bytes = kGlassBytes, glm::ivec2 size = {320, 240})
        : renderer(Renderer::create(glass_bytes).value()) {
        frame.mesh = std::make_shared<const PagedMesh>(mesh);
        frame.size = size;
        frame.camera = camera_for(frame.mesh->positions(), View::kAnterior, frame.size, orthographic);
        frame.camera = turned(frame.camera, 25.0, 10.0);
        frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
        frame.appearance.depth_cue = 0.0F;
        for (int i = 0; i < kVessels; ++i) frame.states.push_back(state_of(i));
    }
    ~GlassScene() { renderer.reset(); }
    Image draw() {
        REQUIRE(context->make_current());
        const auto done = renderer->draw(frame);
        REQUIRE_MESSAGE(done.has_value(), (done ? "" : done.error().message()));
        return renderer->read_image();
    }
};

struct Hit {
    double depth; // along the ray
    int branch;
    glm::dvec3 normal;
};

// Where a ray enters vessels, nearest first, up to the first opaque one, which is left out.
struct Seen {
    std::vector<Hit> fragments;
    int opaque = kNoBranch;
    [[nodiscard]] bool same_surfaces(const Seen& other) const {
        return opaque == other.opaque && std::ranges::equal(fragments, other.fragments, {}, &Hit::branch, &Hit::branch);
    }
};

class RayCaster {
public:
    RayCaster(const TriangleMesh& mesh, const Camera& camera, glm::ivec2 size)
        : mesh_(mesh), camera_(camera), size_(size) {
        for (const glm::uvec3& t : mesh.triangles) {
            if (vessels_.empty() || vessels_.back().branch != mesh.branches[t.z])
                vessels_.push_back({mesh.branches[t.z], {}, glm::dvec3(mesh.positions[t.z]), 0.0});
            vessels_.back().triangles.push_back(t);
        }
        for (Vessel& vessel : vessels_) // a ball around each: most rays miss most vessels
            for (const glm::uvec3& t : vessel.triangles)
                vessel.reach = std::max(vessel.reach, glm::distance(vessel.position, glm::dvec3(mesh.positions[t.x])));
    }

    [[nodiscard]] glm::dvec3 direction(glm::dvec2 pixel) const {
        return glm::normalize(unproject(camera_, size_, pixel, 1000.0) - unproject(camera_, size_, pixel, 1.0));
    }
    [[nodiscard]] Seen cast(glm::dvec2 pixel) const {
        const glm::dvec3 from = unproject(camera_, size_, pixel, 1.0), along = direction(pixel);
        std::vector<Hit> hits;
        for (const Vessel& vessel : vessels_) {
            if (glm::length(glm::cross(vessel.position - from, along)) > vessel.reach + 1.0) continue;
            for (const glm::uvec3& t : vessel.triangles) add_hit(t, from, along, hits);
        }
        std::ranges::sort(hits, {}, &Hit::depth);
        Seen seen;
        for (const Hit& hit : hits) {
            if (state_of(hit.branch) != BranchState::kDefocused) {
                seen.opaque = hit.branch;
                break;
            }
            seen.fragments.push_back(hit);
        }
        return seen;
    }

private:
    struct Vessel {
        int branch;
        std::vector<glm::uvec3> triangles;
        glm::dvec3 position;
        double reach;
    };
    void add_hit(const glm::uvec3& t, const glm::dvec3& from, const glm::dvec3& along, std::vector<Hit>& hits) const {
        const glm::dvec3 a(mesh_.positions[t.x]), ab = glm::dvec3(mesh_.positions[t.y]) - a,
                                                  ac = glm::dvec3(mesh_.positions[t.z]) - a;
        if (glm::dot(glm::cross(ab, ac), along) >= 0.0) return; // its back
        const glm::dvec3 p = glm::cross(along, ac);
        const double determinant = glm::dot(ab, p);
        if (std::abs(determinant) < 1e-14) return;
        const glm::dvec3 s = from - a, q = glm::cross(s, ab);
        const double u = glm::dot(s, p) / determinant, v = glm::dot(along, q) / determinant;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) return;
        hits.push_back({glm::dot(ac, q) / determinant, mesh_.branches[t.z],
                        glm::normalize((1.0 - u - v) * glm::dvec3(mesh_.normals[t.x]) +
                                       u * glm::dvec3(mesh_.normals[t.y]) + v * glm::dvec3(mesh_.normals[t.z]))});
    }

    const TriangleMesh& mesh_;
    const Camera& camera_;
    glm::ivec2 size_;
    std::vector<Vessel> vessels_;
};

// As shaders encode light, and back.
glm::dvec3 bytes_of(const glm::dvec3& light) { return {encoded(light.x), encoded(light.y), encoded(light.z)}; }
glm::dvec3 light_of(const std::uint8_t* bytes, double added) {
    return {decoded(bytes[0] - added), decoded(bytes[1] - added), decoded(bytes[2] - added)};
}

// The veil of one fragment as shaders/shade.frag has it, without depth cue: premultiplied.
glm::dvec4 veil_of_glass(const Appearance& look, const glm::dvec3& normal, const glm::dvec3& towards_eye) {
    const glm::dvec3 key(-0.429, 0.572, 0.699);
    const double facing = std::clamp(glm::dot(normal, towards_eye), 0.0, 1.0);
    const double veil = 0.20 + 0.52 * std::pow(1.0 - facing, 1.6);
    const glm::dvec3 light =
        glm::dvec3(linear(look.glass, 0.0F)) * (0.24 + 0.28 * std::max(0.0, glm::dot(normal, key)));
    const double shine = 0.10 * std::pow(std::max(0.0, glm::dot(normal, glm::normalize(key + towards_eye))), 60.0);
    return {light * veil + shine, std::clamp(veil + shine, 0.0, 1.0)};
}

} // namespace

TEST_CASE("glass is composited as a ray through the same triangles says, perspective or not" *
          doctest::test_suite("slow")) {
    for (const bool orthographic : {false, true}) {
        CAPTURE(orthographic);
        GlassScene scene(orthographic, kGlassBytes, {1280, 960}); // a highlight spans many pixels
        const Image glass = scene.draw();
        for (BranchState& state : scene.frame.states)
            if (state == BranchState::kDefocused) state = BranchState::kHidden;
        const Image without = scene.draw();
        const RayCaster rays(scene.mesh, scene.frame.camera, scene.frame.size);
        const glm::dmat3 to_eye(view_matrix(scene.frame.camera));
        int compared = 0, deepest = 0, behind_opaque = 0;
        double largest = 0.0;
        for (int y = 1; y + 1 < scene.frame.size.y; y += 12)
            for (int x = 1; x + 1 < scene.frame.size.x; x += 12) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                const Seen seen = rays.cast(centre);
                if (seen.fragments.empty()) continue;
                // Away from edges: all around the same surfaces are seen.
                bool edge = false;
                for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}})
                    edge = edge || !seen.same_surfaces(rays.cast(centre + corner));
                if (edge) continue;
                // The mean over the pixel's samples, in linear light.
                const double added = ramus::test::half_step(x, y, scene.frame.size.y);
                glm::dvec3 mean(0.0);
                for (const glm::dvec2 sample :
                     {glm::dvec2(0.375, 0.125), {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}) {
                    const glm::dvec2 at = glm::dvec2(x, y) + sample;
                    const glm::dvec3 towards_eye = -(to_eye * rays.direction(at));
                    glm::dvec3 colour = light_of(without.pixel(x, y), added);
                    const Seen there = rays.cast(at);
                    for (auto fragment = there.fragments.rbegin(); fragment != there.fragments.rend(); ++fragment) {
                        const glm::dvec4 veil =
                            veil_of_glass(scene.frame.appearance, to_eye * fragment->normal, towards_eye);
                        colour = glm::dvec3(veil) + (1.0 - veil.w) * colour;
                    }
                    mean += 0.25 * colour;
                }
                const glm::dvec3 expected = bytes_of(mean) + added;
                for (int k = 0; k < 3; ++k)
                    largest = std::max(largest, std::abs(expected[k] - double(glass.pixel(x, y)[k])));
                ++compared;
                deepest = std::max(deepest, int(seen.fragments.size()));
                behind_opaque += seen.opaque != kNoBranch ? 1 : 0;
            }
        MESSAGE(compared << " pixels, up to " << deepest << " layers, " << behind_opaque
                         << " before something opaque: at most " << largest << " of 255 apart");
        CHECK(compared > 1500);
        CHECK(deepest >= 3);
        CHECK(behind_opaque > 300);
        CHECK(largest <= 2.0);
    }
}

TEST_CASE("the order of triangles makes no difference to glass") {
    GlassScene scene(false);
    const Image before = scene.draw();
    std::mt19937 random(3);
    for (int round = 0; round < 3; ++round) {
        std::ranges::shuffle(scene.mesh.triangles, random);
        scene.frame.mesh = std::make_shared<const PagedMesh>(scene.mesh);
        CHECK(largest_difference(before, scene.draw()) <= 1);
    }
}

TEST_CASE("glass that does not fit into its memory is drawn in bands, with the same pixels" *
          doctest::test_suite("slow")) {
    if (const ramus::test::WatchedContext any; !gl_has_lists()) return; // no lists, no bands
    GlassScene scene(false);
    const Image whole = scene.draw();
    const Pick pick = scene.renderer->pick(160, 120);
    GlassScene narrow(false, 96 * 1024); // 6,143 fragments
    const Image banded = narrow.draw();
    CHECK(largest_difference(whole, banded) == 0);
    CHECK(narrow.renderer->pick(160, 120) == pick);
    // What is pointed at is shaded again, band by band.
    scene.frame.hovered = narrow.frame.hovered = 3;
    const Image hovered = scene.draw();
    CHECK(largest_difference(whole, hovered) > 10);
    CHECK(largest_difference(hovered, narrow.draw()) == 0);
    // Not one row fits.
    GlassScene tiny(false, 10 * 16);
    const auto failed = tiny.renderer->draw(tiny.frame);
    REQUIRE_FALSE(failed);
    CHECK(failed.error().what.find("layers of glass") != std::string::npos);
    tiny.frame.states.assign(kVessels, BranchState::kNormal);
    CHECK(tiny.renderer->draw(tiny.frame));
}
