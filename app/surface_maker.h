// SurfaceMaker: makes the surface of one tree for the window and follows what becomes of it. Hiding and showing
// branches recompute what they touch; whatever changes everything shows a preview first, the same surface with fewer
// triangles, which also stands in while the view moves. One thread at a time; what it hands out is immutable.
#pragma once

#include "app/session.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/field/convolution_field.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "render/paged_mesh.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::app {

// Everything that a surface depends on beside its tree.
struct SurfaceRequest {
    mesh::SurfaceOptions options;
    std::vector<int> hidden; // branch ids, ascending
    bool operator==(const SurfaceRequest&) const = default;
};

[[nodiscard]] SurfaceRequest surface_request(const Marks& marks);
// By branch id, not 0: hidden. Empty when none is.
[[nodiscard]] std::vector<std::uint8_t> hidden_flags(std::span<const int> hidden, std::size_t branch_count);

// A mesh of the tree as it is drawn: all of them have the same origin.
[[nodiscard]] std::shared_ptr<const render::PagedMesh> paged(const mesh::TriangleMesh& mesh,
                                                             const tree::VesselTree& tree);

// A surface that was computed, and what it cost.
struct ReadySurface {
    SurfaceRequest request;
    std::shared_ptr<const render::PagedMesh> mesh;
    std::shared_ptr<const render::PagedMesh> preview; // for while the view moves; null: none, or not yet
    double seconds = 0.0;
    bool provisional = false; // the preview (or rough cones) in place of the surface
};

// The surface from nothing; without any triangle when every branch is hidden.
[[nodiscard]] Result<ReadySurface> make_ready(const tree::VesselTree& tree, const SurfaceRequest& request, Job& job);

class SurfaceMaker {
public:
    explicit SurfaceMaker(std::shared_ptr<const tree::VesselTree> tree) : tree_(std::move(tree)) {}

    // Calls `show` with every better picture, the last one is what was asked for.
    using Show = std::function<void(ReadySurface)>;
    Result<void> make(const SurfaceRequest& request, Job& job, const Show& show);

private:
    using Paged = std::shared_ptr<const render::PagedMesh>;
    struct Followed {
        mesh::Polygonizer polygonizer{mesh::Polygonizer::Purpose::kUpdates};
        Paged mesh; // of the polygonizer's state
    };
    Result<void> make_cones(const SurfaceRequest& request, Job& job, const Show& show);
    Result<void> make_surface(const SurfaceRequest& request, Job& job, const Show& show);
    Result<Paged> follow(Followed& followed, const field::ConvolutionField& field,
                         const mesh::PolygonizeOptions& options, Job& job);
    [[nodiscard]] bool changes_much(const SurfaceRequest& request) const;

    std::shared_ptr<const tree::VesselTree> tree_;
    std::optional<field::ConvolutionField> field_; // of all branches, under the options of `made_`
    std::optional<SurfaceRequest> made_;           // the last one begun
    Followed surface_, preview_;
};

} // namespace ramus::app
