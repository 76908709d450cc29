// Which surface a picture is made of, and what of it the graphics card holds.
#include "render/gl/graphics_memory.h"
#include "render/renderer/renderer_impl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ramus::render {

std::size_t Renderer::Impl::most_surface_bytes() {
    constexpr double kShare = 0.75; // of the graphics card's memory
    const double bytes = kShare * graphics_memory_bytes();
    return std::isinf(bytes) ? std::numeric_limits<std::size_t>::max() : static_cast<std::size_t>(bytes);
}

// The frame as it can be drawn now: its mesh is the one that the graphics card has and that its quality asks for. The
// preview is sent first, and stands in until the mesh has come: drawing the mesh before it in full would be in vain.
Result<Frame> Renderer::Impl::take_up(const Frame& wanted, std::size_t upload_budget, DrawStatistics& done) {
    lines_.follow(wanted.centerlines);
    shapes_.follow(wanted.context, wanted.lesions);
    if (wanted.surface_awaited && wanted.quality == Quality::kInteractive && casts(wanted)) {
        drawn_ = nullptr;
        done.quality = wanted.quality;
        Frame frame = wanted;
        frame.mesh = frame.preview = nullptr;
        return frame;
    }
    const auto whole = fits(wanted);
    if (!whole) return tl::unexpected(whole.error());
    done.coarse = !*whole;
    std::size_t left = upload_budget;
    // Where both do not fit, the surface before gives way first.
    const bool crowded = *whole && wanted.mesh && mesh_.shown() != wanted.mesh &&
                         preview_.bytes() + mesh_.bytes() + GpuMesh::bytes_of(*wanted.mesh) > surface_bytes_;
    if (done.coarse || (crowded && mesh_.shown())) mesh_.follow(nullptr, left);
    preview_.follow(wanted.preview, left);
    if (!done.coarse) mesh_.follow(wanted.mesh, left);
    done.uploaded = upload_budget - left;
    const bool mesh_there = done.coarse || mesh_.shown() == wanted.mesh;
    const bool preview_there = wanted.preview && preview_.shown() == wanted.preview;
    done.pending = !mesh_there || preview_.shown() != wanted.preview;
    Frame frame = wanted;
    if (preview_there && !mesh_there) frame.quality = Quality::kInteractive;
    const bool quick = preview_there && frame.quality == Quality::kInteractive;
    const GpuMesh& mesh = quick || done.coarse ? preview_ : mesh_;
    drawn_ = mesh.shown() && mesh.shown()->triangle_count() > 0 ? &mesh : nullptr;
    frame.mesh = mesh.shown();
    frame.preview = nullptr;
    frame.surface_awaited = false;
    done.quality = frame.quality;
    return frame;
}

// Whether the mesh does. Its preview has to.
Result<bool> Renderer::Impl::fits(const Frame& wanted) const {
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

bool Renderer::Impl::casts(const Frame& frame) const {
    constexpr std::size_t kMostAtOnce = 300'000; // points; of more, what the caster begins with takes too long
    if (lines_.shown() == nullptr || !caster::Caster::draws(frame)) return false;
    return !frame.surface_awaited || lines_.shown()->points.size() <= kMostAtOnce;
}

// After memory has run out.
void Renderer::Impl::let_go() {
    restore_state();
    last_.reset();
    unfinished_.reset();
    refinement_.reset();
    holds_last_ = false;
    drawn_ = nullptr;
    wanted_mesh_ = nullptr;
    mesh_ = {};
    preview_ = {};
    lines_ = {};
    skeleton_ = {};
    shapes_ = {};
    branch_buffer_ = {};
    lesion_buffer_ = {};
    cut_buffer_ = {};
    layer_buffer_ = {};
    context_buffer_ = {};
    branch_capacity_ = lesion_capacity_ = cut_capacity_ = layer_capacity_ = context_capacity_ = 0;
    distances_.reset();
    distance_texture_ = {};
    has_glass_ = false;
    static_cast<Passes&>(*this) = {}; // what the picture was drawn into is made anew
    picture_ = {};
    size_ = inner_ = glm::ivec2(0);
}

} // namespace ramus::render
