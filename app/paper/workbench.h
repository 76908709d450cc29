// Workbench: what all figures draw from: the trees that a person gave, or trees that are grown, their surfaces by the
// paper's three methods with the distances between them, and the artist. What takes long is made when it is first asked
// for and kept.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/plate.h"
#include "app/reports/validation/data_set.h"
#include "core/mesh/surface.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/grow/grow.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/label_choice.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app::paper {

struct InputTree {
    std::string name; // of its file
    std::shared_ptr<const tree::VesselTree> tree;
    std::string mask, mask_units;            // empty: voxels are made of the tree; as its file says
    std::vector<volume::LabelChoice> labels; // in the mask; empty: all
    std::optional<tree::GrowOptions> grown;  // it was not given
};

// The trees in place of given ones: names, and options of `ramus grow` for the same trees.
[[nodiscard]] Facts grown_trees();

// How surfaces of figures are made: as the paper makes them, as far as ramus can.
[[nodiscard]] mesh::SurfaceOptions paper_options(double width = 5.0);

struct MadeSurface {
    mesh::TriangleMesh mesh;
    Paged paged;
};
// Of any tree. The mesh is kept for measuring.
[[nodiscard]] Result<MadeSurface> made_surface(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                                               Job& job);

// The three methods on one tree.
struct ComparedTree {
    InputTree input;
    MadeSurface surface, cones, isosurface;
    std::vector<float> to_cones_mm, to_isosurface_mm; // by vertex of the surface
    double voxel_mm = 0.0;                            // of a mask that was made; 0: it was given
};

// What is kept of every tree: distances and times.
struct TreeResults {
    ValidatedDataSet distances; // its tables and plots are those of `ramus validate`
    std::size_t points = 0, branches = 0;
    struct Step {
        std::string name;
        std::size_t triangles = 0;
        double seconds = 0.0;
    };
    std::vector<Step> steps;
};

class Workbench {
public:
    // `inputs`: given by a person; empty: three trees are grown.
    explicit Workbench(std::vector<InputTree> inputs) : inputs_(std::move(inputs)) {}

    [[nodiscard]] Result<Artist*> artist();
    // The figure with one more picture.
    [[nodiscard]] Result<Figure> with_picture(Figure figure, const std::string& file, const std::string& caption,
                                              const Plate& plate, Job& job);

    // The first tree with its surfaces.
    [[nodiscard]] Result<const ComparedTree*> first(Job& job);
    [[nodiscard]] Result<const TreeResults*> results_of_first(Job& job);
    // All trees.
    [[nodiscard]] Result<const std::vector<TreeResults>*> all(Job& job);

private:
    [[nodiscard]] Result<void> grow_inputs(Job& job);

    std::vector<InputTree> inputs_;
    std::unique_ptr<Artist> artist_;
    std::unique_ptr<const ComparedTree> first_;
    std::vector<TreeResults> all_; // the first of them, or all
};

} // namespace ramus::app::paper
