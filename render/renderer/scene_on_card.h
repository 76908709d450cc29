// SceneOnCard: what pictures are made of, as far as the graphics card holds it, and what a view of it shows.
#pragma once

#include "render/gpu/gpu_lines.h"
#include "render/gpu/gpu_mesh.h"
#include "render/gpu/gpu_shapes.h"
#include "render/renderer/drawn.h"
#include "render/renderer/view_setup.h"

namespace ramus::render {

// The layer of every branch of a mesh, for shaders that tell whose a point is.
struct BranchLayers {
    std::vector<Layer> all;
    TexelTable table{GL_R8UI}; // a byte a branch
    void send(const PagedMesh& mesh, const std::vector<Layer>& layers);
};

class SceneOnCard {
public:
    // `surface_bytes` as for Renderer::create().
    explicit SceneOnCard(std::size_t surface_bytes);

    // The frame as it can be drawn now: its mesh is the one that the card has and that its quality asks for. The
    // preview is sent first, and stands in until the mesh has come: drawing the mesh before it in full would be in
    // vain. Fails where neither fits.
    [[nodiscard]] Result<Frame> take_up(const Frame& wanted, std::size_t upload_budget, DrawStatistics& done);
    // Before the frame taken up last is drawn as `view` looks at it: its surface is divided where that shows.
    void come_near(const Frame& frame, const ViewSetup& view);
    // Whether somebody waits for the picture: it is divided as far as that takes no time to speak of.
    void hurry(bool in_time) { in_time_ = in_time; }
    // Whether the caster can draw it.
    [[nodiscard]] bool casts(const Frame& frame) const;
    void let_go(); // after memory has run out

    [[nodiscard]] std::size_t surface_bytes() const { return surface_bytes_; }
    // Of the frame taken up last; an empty one: there is no surface.
    [[nodiscard]] const GpuMesh& mesh() const { return drawn_ != nullptr ? *drawn_ : none_; }
    // The surface of the frame taken up last in full; null: it is not there, or only its preview is.
    [[nodiscard]] const std::shared_ptr<const PagedMesh>& whole_surface() const { return whole_surface_; }
    [[nodiscard]] GpuLines& lines() { return lines_; }
    [[nodiscard]] const GpuLines& lines() const { return lines_; }
    [[nodiscard]] const GpuShapes& shapes() const { return shapes_; }
    [[nodiscard]] GpuSkeleton& skeleton() { return skeleton_; }
    [[nodiscard]] BranchLayers& branch_layers() { return branch_layers_; } // of the view drawn last
    // Lesions and context, around their centres.
    [[nodiscard]] std::vector<ViewSetup::Ball> beside_tree(const Frame& frame) const;

private:
    [[nodiscard]] Result<bool> fits(const Frame& wanted) const;

    GpuMesh mesh_, preview_;
    const GpuMesh none_;
    GpuLines lines_;
    GpuSkeleton skeleton_;
    GpuShapes shapes_;
    BranchLayers branch_layers_;
    const GpuMesh* drawn_ = nullptr; // null: nothing
    std::shared_ptr<const PagedMesh> whole_surface_;
    struct Near { // what mesh_ is divided for
        std::shared_ptr<const PagedMesh> mesh;
        Camera camera;
        glm::ivec2 size{0};
        bool operator==(const Near&) const = default;
    };
    Near near_;
    bool in_time_ = false;
    std::size_t surface_bytes_; // that surfaces may take
};

// What a view shows. All of it outlives the drawing.
struct Subject {
    const Frame& frame;
    const std::vector<Layer>& layers; // by branch; branches beyond its end are opaque
    const GpuMesh& mesh;              // may be empty
    SceneOnCard& scene;

    [[nodiscard]] bool has_mesh() const { return mesh.shown() != nullptr; }
    [[nodiscard]] bool has_values() const { return has_mesh() && mesh.shown()->has_values(); }
    [[nodiscard]] bool has_lesions() const { return !frame.lesions.spheres.empty() || !frame.lesions.meshes.empty(); }
    [[nodiscard]] bool has_glass_vessels() const;
    // Glass, context that is clear, or lesions.
    [[nodiscard]] bool has_glass() const;
    [[nodiscard]] bool quick() const { return frame.quality == Quality::kInteractive; }
    // Positions relative to the mesh's origin.
    [[nodiscard]] glm::dmat4 mesh_to_clip(const ViewSetup& view) const;
};

// Context meshes and lesions in ids: numbers from 1 on, as far as there are any.
[[nodiscard]] std::uint32_t number_of(std::size_t index);

} // namespace ramus::render
