#include "render/renderer/scene_on_card.h"

#include "render/caster/caster.h"
#include "render/gl/gl_context.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ramus::render {

namespace {

// Limits memory for smooth outlines to 120 MB.
constexpr NearLimits kMostNear{3'000'000, std::numeric_limits<std::size_t>::max()};
// These limits take at most some tenths of a second; the remaining outlines have small errors.
constexpr NearLimits kMostNearInTime{500'000, 250'000};

std::size_t most_surface_bytes() {
    constexpr double kShare = 0.75; // share of the graphics card's memory
    const double bytes = kShare * graphics_memory_bytes();
    return std::isinf(bytes) ? std::numeric_limits<std::size_t>::max() : static_cast<std::size_t>(bytes);
}

} // namespace

SceneOnCard::SceneOnCard(std::size_t surface_bytes)
    : surface_bytes_(surface_bytes == kMostOfGraphicsMemory ? most_surface_bytes() : surface_bytes) {}

Result<Frame> SceneOnCard::take_up(const Frame& wanted, std::size_t upload_budget, DrawStatistics& done) {
    lines_.follow(wanted.centerlines);
    std::size_t left = upload_budget;
    const bool shapes_there = shapes_.follow(wanted.context, wanted.lesions, !in_time_, left);
    const auto with_what_is_there = [&](Frame frame) {
        std::erase_if(frame.context, [&](const ContextMesh& one) {
            return one.shown() && (shapes_.of(one, false) == nullptr || shapes_.of(one, true) == nullptr);
        });
        return frame;
    };
    if (wanted.surface_awaited && wanted.quality == Quality::kInteractive && casts(wanted)) {
        drawn_ = nullptr;
        whole_surface_ = nullptr;
        done.quality = wanted.quality;
        done.pending = !shapes_there;
        Frame frame = with_what_is_there(wanted);
        frame.mesh = frame.preview = nullptr;
        return frame;
    }
    RAMUS_TRY(whole, fits(wanted));
    done.coarse = !whole;
    // If both do not fit, the previous surface is released first.
    const bool crowded = whole && wanted.mesh && mesh_.shown() != wanted.mesh &&
                         preview_.bytes() + mesh_.bytes() + GpuMesh::bytes_of(*wanted.mesh) > surface_bytes_;
    if (done.coarse || (crowded && mesh_.shown())) mesh_.follow(nullptr, left);
    preview_.follow(wanted.preview, left);
    if (!done.coarse) mesh_.follow(wanted.mesh, left);
    if (mesh_.shown() != near_.mesh) near_ = {};
    done.uploaded = upload_budget - left;
    const bool mesh_there = done.coarse || mesh_.shown() == wanted.mesh;
    const bool preview_there = wanted.preview && preview_.shown() == wanted.preview;
    done.pending = !mesh_there || preview_.shown() != wanted.preview || !shapes_there;
    Frame frame = with_what_is_there(wanted);
    if (preview_there && !mesh_there) frame.quality = Quality::kInteractive;
    const bool quick = preview_there && frame.quality == Quality::kInteractive;
    const GpuMesh& mesh = quick || done.coarse ? preview_ : mesh_;
    drawn_ = mesh.shown() && mesh.shown()->triangle_count() > 0 ? &mesh : nullptr;
    whole_surface_ = mesh_there && !done.coarse ? wanted.mesh : nullptr;
    frame.mesh = mesh.shown();
    frame.preview = nullptr;
    // The previous surface may have values, but not those of the frame's scale.
    const bool is_wanted = frame.mesh && (frame.mesh == wanted.mesh || frame.mesh == wanted.preview);
    if (frame.scale.value == ColourScale::Value::kSurface && !is_wanted) frame.scale = {};
    frame.surface_awaited = false;
    if (frame.quality != Quality::kInteractive) frame.cones = nullptr; // not drawn by the caster
    done.quality = frame.quality;
    return frame;
}

// Views that are shifted by less than a pixel share the division.
void SceneOnCard::divide_near_surface(const Frame& frame, const ViewSetup& view) {
    const bool bends = frame.bends && frame.quality == Quality::kFull && drawn_ == &mesh_;
    const Near near = bends ? Near{mesh_.shown(), frame.camera, view.size} : Near{};
    if (near == near_) return;
    near_ = {};
    mesh_.use_near_surface(bends ? near_surface(*near.mesh,
                                                near_view(frame.camera, near.mesh->origin(), view.to_clip, view.size.y),
                                                in_time_ ? kMostNearInTime : kMostNear)
                                 : NearSurface{});
    near_ = near;
}

// Returns whether the mesh fits; fails if its preview does not.
Result<bool> SceneOnCard::fits(const Frame& wanted) const {
    const auto bytes = [](const auto& mesh) { return mesh ? GpuMesh::bytes_of(*mesh) : 0; };
    if (bytes(wanted.mesh) + bytes(wanted.preview) <= surface_bytes_) return true;
    if (wanted.preview && bytes(wanted.preview) <= surface_bytes_) return false;
    const auto megabytes = [](std::size_t b) {
        return std::to_string(std::max(1L, std::lround(static_cast<double>(b) / 1e6)));
    };
    return fail("the surface takes " + megabytes(bytes(wanted.mesh)) + " MB of graphics memory, where it may take " +
                    megabytes(surface_bytes_),
                {}, "lower --detail, hide or prune branches, or raise --graphics-memory");
}

bool SceneOnCard::casts(const Frame& frame) const {
    if (lines_.shown() == nullptr || !caster::Caster::draws(frame)) return false;
    return !frame.surface_awaited || lines_.shown()->points.size() <= caster::kMostCastPoints;
}

void SceneOnCard::release() {
    drawn_ = nullptr;
    whole_surface_ = nullptr;
    near_ = {};
    mesh_ = {};
    preview_ = {};
    lines_ = {};
    skeleton_ = {};
    shapes_ = {};
    branch_layers_ = {};
}

std::vector<ViewSetup::Ball> SceneOnCard::beside_tree(const Frame& frame) const {
    std::vector<ViewSetup::Ball> balls;
    for (const glm::dvec4& sphere : frame.lesions.spheres) balls.push_back({glm::dvec3(sphere), sphere.w});
    const auto add = [&](const Box& box) {
        if (!box.empty()) balls.push_back({box.centre(), box.radius()});
    };
    for (const auto& lesion : frame.lesions.meshes)
        if (const Shape* shape = shapes_.of(lesion); shape != nullptr) add(shape->bounds());
    add(shapes_.bounds(frame.context));
    return balls;
}

bool Subject::has_glass_vessels() const {
    return has_mesh() && std::ranges::find(layers, Layer::kGlass) != layers.end();
}

bool Subject::has_glass() const {
    return has_glass_vessels() || has_lesions() || std::ranges::any_of(frame.context, &ContextMesh::clear);
}

glm::dmat4 Subject::mesh_to_clip(const ViewSetup& view) const {
    return has_mesh() ? view.clip_from(mesh.shown()->origin()) : glm::dmat4(1.0);
}

void BranchLayers::send(const PagedMesh& mesh, const std::vector<Layer>& layers) {
    all = layers;
    all.resize(static_cast<std::size_t>(mesh.branch_count()), Layer::kOpaque);
    table.send(all);
}

std::uint32_t number_of(std::size_t index) {
    return static_cast<std::uint32_t>(std::min(index + 1, std::size_t{record::kNumberBits}));
}

} // namespace ramus::render
