// SurfaceMaker: makes the surface of one tree for the window and follows what becomes of it. Hiding and showing
// branches recompute what they touch; whatever changes everything gives a preview first, the same surface with fewer
// triangles, which also stands in while the view moves. Any thread may ask; they take turns. What it hands out is
// immutable.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/field/convolution_field.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "render/scene/paged_mesh.h"

#include <cstdint>
#include <memory>
#include <mutex>
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
    bool preview_follows = false;
};

// The surface from nothing; without any triangle when every branch is hidden.
[[nodiscard]] Result<ReadySurface> make_ready(const tree::VesselTree& tree, const SurfaceRequest& request, Job& job);

class SurfaceMaker {
public:
    explicit SurfaceMaker(std::shared_ptr<const tree::VesselTree> tree) : tree_(std::move(tree)) {}

    // The next better picture of what is asked for. While it is provisional or its preview follows, ask again.
    [[nodiscard]] Result<ReadySurface> next(const SurfaceRequest& request, Job& job);

private:
    using Paged = std::shared_ptr<const render::PagedMesh>;
    struct Followed {
        mesh::Polygonizer polygonizer;
        Paged mesh;    // of the polygonizer's state
        Paged current; // what was asked for last
    };
    [[nodiscard]] Result<ReadySurface> next_cones(const SurfaceRequest& request, Job& job) const;
    [[nodiscard]] Result<ReadySurface> next_surface(const SurfaceRequest& request, Job& job);
    [[nodiscard]] Result<void> follow(Followed& followed, const field::ConvolutionField& field,
                                      const mesh::PolygonizeOptions& options, Job& job) const;
    [[nodiscard]] bool changes_much(const SurfaceRequest& request) const;

    std::shared_ptr<const tree::VesselTree> tree_;
    std::mutex turn_;                              // guards what follows
    std::optional<field::ConvolutionField> field_; // of all branches, under field_options_
    mesh::SurfaceOptions field_options_;
    std::optional<SurfaceRequest> surface_of_, preview_of_; // what the two are up to
    Followed surface_, preview_;
};

} // namespace ramus::app
