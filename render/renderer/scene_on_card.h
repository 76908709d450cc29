// SceneOnCard: the copies of a frame's large values (mesh, centerlines, shapes) on the graphics card. Subject: one view
// of them.
#pragma once

#include "render/gpu/gpu_lines.h"
#include "render/gpu/gpu_mesh.h"
#include "render/gpu/gpu_shapes.h"
#include "render/renderer/drawn.h"
#include "render/renderer/view_setup.h"

namespace ramus::render {

// The layer of every branch of a mesh, for shaders that determine the branch per point.
struct BranchLayers {
    std::vector<Layer> all;
    TexelTable table{GL_R8UI}; // one byte per branch
    void send(const PagedMesh& mesh, const std::vector<Layer>& layers);
};

class SceneOnCard {
public:
    // `surface_bytes`: see Renderer::create().
    explicit SceneOnCard(std::size_t surface_bytes);

    // Returns the frame as it can be drawn now, with the mesh that is on the card and fits the requested quality. The
    // preview is sent first and stands in until the mesh is complete. Fails if neither fits.
    [[nodiscard]] Result<Frame> take_up(const Frame& wanted, std::size_t upload_budget, DrawStatistics& done);
    // Call before drawing the frame of the last take_up() from `view`: divides its surface where straight edges would
    // show.
    void divide_near_surface(const Frame& frame, const ViewSetup& view);
    // `in_time`: a person waits for the picture, so the surface is divided only as far as that is quick.
    void set_in_time(bool in_time) { in_time_ = in_time; }
    // Whether the caster can draw the frame.
    [[nodiscard]] bool casts(const Frame& frame) const;
    void release(); // call after running out of memory

    [[nodiscard]] std::size_t surface_bytes() const { return surface_bytes_; }
    // The mesh of the last take_up(); empty if there is no surface.
    [[nodiscard]] const GpuMesh& mesh() const { return drawn_ != nullptr ? *drawn_ : none_; }
    // The full surface of the last take_up(); null if it is missing or only its preview is on the card.
    [[nodiscard]] const std::shared_ptr<const PagedMesh>& whole_surface() const { return whole_surface_; }
    [[nodiscard]] GpuLines& lines() { return lines_; }
    [[nodiscard]] const GpuLines& lines() const { return lines_; }
    [[nodiscard]] const GpuShapes& shapes() const { return shapes_; }
    [[nodiscard]] GpuSkeleton& skeleton() { return skeleton_; }
    [[nodiscard]] BranchLayers& branch_layers() { return branch_layers_; } // of the last view drawn
    // Bounding spheres of lesions and context.
    [[nodiscard]] std::vector<ViewSetup::Ball> beside_tree(const Frame& frame) const;

private:
    [[nodiscard]] Result<bool> fits(const Frame& wanted) const;

    GpuMesh mesh_, preview_;
    const GpuMesh none_;
    GpuLines lines_;
    GpuSkeleton skeleton_;
    GpuShapes shapes_;
    BranchLayers branch_layers_;
    const GpuMesh* drawn_ = nullptr; // null: no surface
    std::shared_ptr<const PagedMesh> whole_surface_;
    struct Near { // the view for which mesh_ is divided
        std::shared_ptr<const PagedMesh> mesh;
        Camera camera;
        glm::ivec2 size{0};
        bool operator==(const Near&) const = default;
    };
    Near near_;
    bool in_time_ = false;
    std::size_t surface_bytes_; // limit for surfaces
};

// What a view shows. References must outlive the drawing.
struct Subject {
    const Frame& frame;
    const std::vector<Layer>& layers; // by branch; branches without an entry are opaque
    const GpuMesh& mesh;              // may be empty
    SceneOnCard& scene;

    [[nodiscard]] bool has_mesh() const { return mesh.shown() != nullptr; }
    [[nodiscard]] bool has_values() const { return has_mesh() && mesh.shown()->has_values(); }
    [[nodiscard]] bool has_lesions() const { return !frame.lesions.spheres.empty() || !frame.lesions.meshes.empty(); }
    [[nodiscard]] bool has_glass_vessels() const;
    // Glass, transparent context, or lesions.
    [[nodiscard]] bool has_glass() const;
    [[nodiscard]] bool quick() const { return frame.quality == Quality::kInteractive; }
    // From positions relative to the mesh's origin.
    [[nodiscard]] glm::dmat4 mesh_to_clip(const ViewSetup& view) const;
};

// Number of a context mesh or lesion in ids: counts from 1 and saturates.
[[nodiscard]] std::uint32_t number_of(std::size_t index);

} // namespace ramus::render
