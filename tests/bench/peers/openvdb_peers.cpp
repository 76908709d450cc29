#include "brick_fill.h"
#include "core/field/convolution_field.h"
#include "core/mesh/surface_options.h"
#include "peers.h"

#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <openvdb/openvdb.h>
#include <openvdb/tools/ParticlesToLevelSet.h>
#include <openvdb/tools/VolumeToMesh.h>

namespace ramus::peers {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
static_assert(Leaf::DIM == kBrickPoints * kBlockBricks);

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Polygons {
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
};

// The surface where the grid changes its sign, as quads.
Made mesh_of(const openvdb::FloatGrid& grid) {
    const auto polygons = std::make_shared<Polygons>();
    openvdb::tools::volumeToMesh(grid, polygons->points, polygons->triangles, polygons->quads, 0.0, 0.0);
    Made made;
    made.triangles = polygons->triangles.size() + 2 * polygons->quads.size();
    made.plain = [polygons] {
        PlainMesh plain;
        plain.positions.reserve(polygons->points.size());
        for (const openvdb::Vec3s& p : polygons->points) plain.positions.emplace_back(p[0], p[1], p[2]);
        plain.triangles.reserve(polygons->triangles.size() + 2 * polygons->quads.size());
        // Its polygons go clockwise seen from outside.
        for (const openvdb::Vec3I& t : polygons->triangles) plain.triangles.emplace_back(t[0], t[2], t[1]);
        for (const openvdb::Vec4I& q : polygons->quads) {
            plain.triangles.emplace_back(q[0], q[2], q[1]);
            plain.triangles.emplace_back(q[0], q[3], q[2]);
        }
        return plain;
    };
    return made;
}

// Spheres along every segment, at the distance from each other that OpenVDB's own trails of particles have: half a
// radius. Those trails cannot be used as they are, for they all taper to one smallest radius at their ends.
class SpheresAlong {
public:
    using PosType = openvdb::Vec3R;

    explicit SpheresAlong(const tree::VesselTree& tree) {
        for (const tree::Branch& branch : tree.branches) {
            for (std::size_t i = 1; i < branch.points.size(); ++i) {
                const tree::Point& from = tree.points[branch.points[i - 1]];
                const tree::Point& to = tree.points[branch.points[i]];
                const double length = glm::distance(from.position, to.position);
                for (double t = 0.0; t < length;) {
                    const double share = t / length;
                    const double radius = glm::mix(from.radius, to.radius, share);
                    spheres_.push_back({glm::mix(from.position, to.position, share), radius});
                    t += 0.5 * radius;
                }
            }
            spheres_.push_back(tree.points[branch.points.back()]);
        }
    }

    [[nodiscard]] std::size_t size() const { return spheres_.size(); }
    void getPos(std::size_t n, openvdb::Vec3R& position) const {
        const glm::dvec3& p = spheres_[n].position;
        position = {p.x, p.y, p.z};
    }
    void getPosRad(std::size_t n, openvdb::Vec3R& position, openvdb::Real& radius) const {
        getPos(n, position);
        radius = spheres_[n].radius;
    }

private:
    std::vector<tree::Point> spheres_;
};

} // namespace

Made openvdb_spheres(const Scene& scene) {
    openvdb::initialize();
    const auto start = std::chrono::steady_clock::now();
    const auto grid =
        openvdb::createLevelSet<openvdb::FloatGrid>(scene.cell_mm, static_cast<float>(openvdb::LEVEL_SET_HALF_WIDTH));
    {
        const SpheresAlong spheres(scene.prepared.tree);
        openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid> raster(*grid);
        raster.setRmin(0.0); // no vessel is left out, however thin
        raster.setRmax(1e9);
        raster.rasterizeSpheres(spheres);
        raster.finalize(true);
    }
    const double fill_s = seconds_since(start);
    Made made = mesh_of(*grid);
    made.fill_s = fill_s;
    return made;
}

Made openvdb_field(const Scene& scene) {
    openvdb::initialize();
    const field::ConvolutionField field(scene.prepared, mesh::SurfaceOptions().width);
    const BrickGrid bricks = brick_grid(field, scene.cell_mm);
    const auto start = std::chrono::steady_clock::now();
    // What is inside is negative to OpenVDB.
    const auto isovalue = static_cast<float>(field.kernel().isovalue);
    std::vector<std::vector<std::unique_ptr<Leaf>>> layers(static_cast<std::size_t>(bricks.blocks.z));
    fill_bricks(field, bricks, [&](glm::ivec3 brick, const field::GridGroups& samples) {
        auto& leaves = layers[static_cast<std::size_t>(brick.z / kBlockBricks)];
        const glm::ivec3 block = brick / kBlockBricks * static_cast<int>(Leaf::DIM);
        const openvdb::Coord origin(block.x, block.y, block.z);
        if (leaves.empty() || leaves.back()->origin() != origin)
            leaves.push_back(std::make_unique<Leaf>(origin, isovalue, false));
        const glm::ivec3 first = brick % kBlockBricks * kBrickPoints;
        Leaf& leaf = *leaves.back();
        for (int z = 0; z < kBrickPoints; ++z)
            for (int y = 0; y < kBrickPoints; ++y)
                for (int x = 0; x < kBrickPoints; ++x) {
                    const float value =
                        samples.value[static_cast<std::size_t>(z)][static_cast<std::size_t>(kBrickPoints * y + x)];
                    leaf.setValueOn(Leaf::coordToOffset({first.x + x, first.y + y, first.z + z}), isovalue - value);
                }
    });
    const auto grid = openvdb::FloatGrid::create(isovalue);
    const auto transform = openvdb::math::Transform::createLinearTransform(bricks.cell_mm);
    transform->postTranslate({bricks.origin.x, bricks.origin.y, bricks.origin.z});
    grid->setTransform(transform);
    grid->setGridClass(openvdb::GRID_LEVEL_SET); // decides which way the polygons face
    for (auto& leaves : layers)
        for (auto& leaf : leaves) grid->tree().addLeaf(leaf.release()); // the tree takes it
    const double fill_s = seconds_since(start);
    Made made = mesh_of(*grid);
    made.fill_s = fill_s;
    return made;
}

} // namespace ramus::peers
