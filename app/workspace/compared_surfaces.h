// The surfaces that are compared with each other: how one is asked for and made, for the window, pictures without one
// and studies alike. A mask's surface has no branches: its mesh calls all of it branch 0.
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

// Everything that it depends on beside its tree.
struct ComparedRequest {
    Compared kind = Compared::kConvolutionSurface;
    SurfaceRequest surface;                  // of an isosurface threads and memory alone
    std::string mask;                        // of an isosurface; empty: a mask of the tree's own voxels
    std::string units;                       // of its lengths; empty: as its file says
    std::vector<volume::LabelChoice> labels; // in it; empty: all
    double voxel_mm = 0.0;                   // without a mask; 0: a sensible size
    bool wire = false;                       // for lines: triangles large enough to be seen one by one
    bool operator==(const ComparedRequest&) const = default;
    // Whether a surface of the one takes the place of one of the other.
    [[nodiscard]] bool same_place(const ComparedRequest& other) const {
        return kind == other.kind && wire == other.wire;
    }
};

struct ComparedSurface {
    ComparedRequest request;
    std::shared_ptr<const render::PagedMesh> mesh;           // null for lines
    std::shared_ptr<const render::PagedMesh> preview;        // of an isosurface that is large: for while the view moves
    std::shared_ptr<const mesh::TriangleMesh> lines;         // null for surfaces
    std::shared_ptr<const mesh::TriangleMesh> lines_preview; // likewise
    double voxel_mm = 0.0;                                   // of a mask that was made; 0: none was
    std::vector<std::string> notes;                          // what was assumed where the mask does not say
};

[[nodiscard]] ComparedRequest compared_request(const Marks& marks, Compared kind);
// All that the picture needs beside the session's own surface, in the order of its viewports.
[[nodiscard]] std::vector<ComparedRequest> compared_requests(const Marks& marks);

// The surface alone, as triangles.
struct ComparedMesh {
    mesh::TriangleMesh mesh;                 // without any triangle where all is hidden
    double voxel_mm = 0.0;                   // of a mask that was made; 0: none was
    std::optional<double> voxel_diagonal_mm; // of the mask's voxels, made or read
    std::vector<std::string> notes;          // what was assumed where the mask does not say
};
// Fails as surfaces, volumes and isosurfaces do, with the mask's name, and when the mask lies elsewhere than the tree.
[[nodiscard]] Result<ComparedMesh> compared_mesh(const tree::VesselTree& tree, const ComparedRequest& request,
                                                 Job& job);
// Whether the box around a surface and the one around the tree have nothing in common.
[[nodiscard]] bool lies_elsewhere(const mesh::TriangleMesh& surface, const tree::VesselTree& tree);

// The same for pictures.
[[nodiscard]] Result<ComparedSurface> make_compared(const tree::VesselTree& tree, const ComparedRequest& request,
                                                    Job& job);

// `surface` in the place of one of its kind.
void show(ShownSurfaces& shown, const ComparedSurface& surface);

} // namespace ramus::app
