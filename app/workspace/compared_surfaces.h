// Makes the surfaces of a comparison, for the window, headless pictures and studies. A mask's surface has no branches:
// all of its mesh is branch 0.
#pragma once

#include "app/picture/shown_surfaces.h"
#include "app/session/comparison.h"
#include "app/workspace/surface_maker.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

// Everything that a compared surface depends on, except its tree.
struct ComparedRequest {
    Compared kind = Compared::kConvolutionSurface;
    SurfaceRequest surface;                  // for an isosurface only threads and memory
    std::string mask;                        // for an isosurface; empty: voxelize the tree
    std::string units;                       // unit of the mask; empty: as its file says
    std::vector<volume::LabelChoice> labels; // labels of the mask; empty: all
    double voxel_mm = 0.0;                   // for voxelizing the tree; 0: a default size
    bool wire = false;                       // for a wireframe: triangles large enough to be distinguishable
    bool operator==(const ComparedRequest&) const = default;
    // Whether a surface for one request replaces a surface for the other.
    [[nodiscard]] bool same_place(const ComparedRequest& other) const {
        return kind == other.kind && wire == other.wire;
    }
};

struct ComparedSurface {
    ComparedRequest request;
    std::shared_ptr<const render::PagedMesh> mesh;           // null for lines
    std::shared_ptr<const render::PagedMesh> preview;        // of a large isosurface, for moving views
    std::shared_ptr<const mesh::TriangleMesh> lines;         // null for surfaces
    std::shared_ptr<const mesh::TriangleMesh> lines_preview; // the same for lines
    double voxel_mm = 0.0;                                   // voxel size if the tree was voxelized; otherwise 0
    std::vector<std::string> notes;                          // assumptions where the mask says nothing
};

[[nodiscard]] ComparedRequest compared_request(const Marks& marks, Compared kind);
// The surfaces that the picture needs in addition to the session's own, in the order of viewports.
[[nodiscard]] std::vector<ComparedRequest> compared_requests(const Marks& marks);

// A compared surface as triangles.
struct ComparedMesh {
    mesh::TriangleMesh mesh;                 // empty if all branches are hidden
    double voxel_mm = 0.0;                   // voxel size if the tree was voxelized; otherwise 0
    std::optional<double> voxel_diagonal_mm; // of the mask's voxels
    std::vector<std::string> notes;          // assumptions where the mask says nothing
};
// Fails like making surfaces, volumes and isosurfaces, with the mask's name in the error, and if the mask does not
// overlap the tree.
[[nodiscard]] Result<ComparedMesh> compared_mesh(const tree::VesselTree& tree, const ComparedRequest& request,
                                                 Job& job);
// Whether the bounding boxes of the surface and the tree are disjoint.
[[nodiscard]] bool lies_elsewhere(const mesh::TriangleMesh& surface, const tree::VesselTree& tree);

// The same, prepared for pictures.
[[nodiscard]] Result<ComparedSurface> make_compared(const tree::VesselTree& tree, const ComparedRequest& request,
                                                    Job& job);

// Puts `surface` in the place of its kind.
void show(ShownSurfaces& shown, const ComparedSurface& surface);

} // namespace ramus::app
