#include "core/field/surface_projector.h"

#include "core/base/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>
#include <optional>

namespace ramus::field {

namespace {

using DrawnPlace = SurfaceProjector::Point;

// The cubes that contain a point: a brick of four to eight cells, and a block of bricks with a common list of segments.
constexpr int kBlockBricks = 8; // along an axis
struct CubeOfPoint {
    std::size_t field = 0;
    int size = 0; // side of the brick, as a power of two, mm
    std::array<int, 3> block{}, brick{};
    std::uint32_t point = 0;
    auto operator<=>(const CubeOfPoint&) const = default; // NOLINT(modernize-use-nullptr): what clang makes of it

    [[nodiscard]] double side() const { return std::ldexp(1.0, size); }
    [[nodiscard]] bool same_block(const CubeOfPoint& o) const {
        return field == o.field && size == o.size && block == o.block;
    }
    [[nodiscard]] bool same_brick(const CubeOfPoint& o) const { return same_block(o) && brick == o.brick; }
};

CubeOfPoint cube_of(const DrawnPlace& point, std::size_t field, std::uint32_t number) {
    constexpr float kLeastCell = 1e-12F;
    CubeOfPoint cube;
    cube.field = field, cube.point = number;
    cube.size = std::ilogb(std::max(point.cell, kLeastCell)) + 3; // four to eight cells
    for (int axis = 0; axis < 3; ++axis) {
        const double brick = std::floor(point.at[axis] / cube.side());
        const auto n = static_cast<std::size_t>(axis);
        cube.brick[n] = static_cast<int>(brick);
        cube.block[n] = static_cast<int>(std::floor(brick / kBlockBricks));
    }
    return cube;
}

Bounds<glm::dvec3> box_of(const std::array<int, 3>& cube, double side, double around) {
    const glm::dvec3 corner = side * glm::dvec3(cube[0], cube[1], cube[2]);
    return {corner - around, corner + side + around};
}

// The segments of `among` that may reach a box.
std::vector<std::uint32_t> segments_reaching(const Field& field, SegmentIndices among, const Bounds<glm::dvec3>& box) {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t n : among) {
        const FieldSegment& s = field.skeleton().segments()[n];
        const glm::dvec3 start(s.ax, s.ay, s.az);
        const double reach = field.support_radii() * static_cast<double>(s.thickest());
        Bounds<glm::dvec3> reached;
        reached.hold(start, reach);
        reached.hold(start + static_cast<double>(s.length) * glm::dvec3(s.ux, s.uy, s.uz), reach);
        if (reached.meets(box)) found.push_back(n);
    }
    return found;
}

// Projects the points of one brick.
class BrickOfPoints {
public:
    BrickOfPoints(const Field& field, std::span<DrawnPlace> points)
        : field_(field), brick_(field.in_brick()), points_(points) {}

    void move(std::span<const CubeOfPoint> cubes, SegmentIndices list) {
        if (list.empty()) return;
        constexpr int kCells = kGridSide - 1;
        const double side = cubes.front().side();
        list_ = list;
        corner_ = box_of(cubes.front().brick, side, 0.0).least;
        GridAxes axes;
        for (std::size_t n = 0; n < axes.x.size(); ++n) {
            const double along = side / kCells * static_cast<double>(n);
            axes.x[n] = corner_.x + along, axes.y[n] = corner_.y + along, axes.z[n] = corner_.z + along;
        }
        brick_->enter(list, axes);
        Separation* separation = brick_->separation();
        plain_.clear();
        for (const CubeOfPoint& cube : cubes) {
            DrawnPlace& point = points_[cube.point];
            const glm::vec3 local(point.at - corner_);
            if (separation != nullptr && separation->beside_contact(local))
                move_beside_contact(*separation, point, local);
            else
                plain_.push_back(cube.point);
        }
        project();
    }

private:
    // The segment of the point's branch that is nearest in radii.
    [[nodiscard]] Owner owner_of(const DrawnPlace& point) const {
        Owner nearest = kNoOwner;
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t n : list_) {
            const FieldSegment& s = field_.skeleton().segments()[n];
            if (s.branch != point.branch) continue;
            const glm::dvec3 from_start = point.at - glm::dvec3(s.ax, s.ay, s.az), along(s.ux, s.uy, s.uz);
            const double at = std::clamp(glm::dot(from_start, along), 0.0, static_cast<double>(s.length));
            const double radii = glm::length(from_start - at * along) / (s.radius + s.slope * at);
            if (radii < least) least = radii, nearest = static_cast<Owner>(n);
        }
        return nearest;
    }
    void move_beside_contact(Separation& separation, DrawnPlace& point, const glm::vec3& local) {
        OwnedGuess whose;
        whose.owner = owner_of(point);
        whose.place = OwnedGuess::Place::kBox;
        whose.lower = local - point.reach, whose.upper = local + point.reach;
        const DrawnPoint drawn = separation.draw(whose, local, point.onward);
        point.at = corner_ + glm::dvec3(drawn.at);
        point.normal = drawn.normal;
        point.place = drawn.place;
        point.beside_contact = true;
    }
    // Projects the points away from contacts together. The error of a projection is of the order of its squared step,
    // so a second projection from its result is exact to single precision.
    void project() {
        constexpr int kTimes = 2;
        if (plain_.empty()) return;
        const std::size_t room = plain_.size() + kProjectionPadding;
        positions_.resize(room), normals_.resize(room), radii_.resize(room);
        branches_.resize(room), dominance_.resize(room);
        for (int time = 0; time < kTimes; ++time) {
            guesses_.clear();
            for (std::size_t n = 0; n < plain_.size(); ++n) {
                const DrawnPlace& point = points_[plain_[n]];
                const glm::dvec3 from = time == 0 ? point.at : glm::dvec3(positions_[n]);
                guesses_.add(glm::vec3(from - corner_), glm::vec3(point.at - corner_), point.reach);
            }
            brick_->project(guesses_,
                            {positions_.data(), normals_.data(), radii_.data(), branches_.data(), dominance_.data()});
        }
        for (std::size_t n = 0; n < plain_.size(); ++n) {
            DrawnPlace& point = points_[plain_[n]];
            point.at = glm::dvec3(positions_[n]);
            point.normal = normals_[n];
            point.place = DrawnPoint::Place::kOwn;
            point.beside_contact = false;
        }
    }

    const Field& field_;
    std::unique_ptr<BrickField> brick_;
    std::span<DrawnPlace> points_;
    SegmentIndices list_;
    glm::dvec3 corner_{0.0};
    std::vector<std::uint32_t> plain_;
    Projection guesses_;
    std::vector<glm::vec3> positions_, normals_;
    std::vector<float> radii_;
    std::vector<std::int32_t> branches_;
    std::vector<Dominance> dominance_;
};

// Divides the list into runs of cubes that are the `same`: the index at which each run begins, and the end.
template <class Same> std::vector<std::size_t> stretches(std::span<const CubeOfPoint> cubes, const Same& same) {
    std::vector<std::size_t> begins;
    for (std::size_t n = 0; n < cubes.size(); ++n)
        if (n == 0 || !same(cubes[n - 1], cubes[n])) begins.push_back(n);
    begins.push_back(cubes.size());
    return begins;
}

} // namespace

SurfaceProjector::SurfaceProjector(std::vector<Field> fields) : fields_(std::move(fields)) {
    if (fields_.size() < 2) return;
    for (std::size_t n = 0; n < fields_.size(); ++n) {
        const Skeleton& skeleton = fields_[n].skeleton();
        for (const std::uint32_t segment : skeleton.present()) {
            const auto branch = static_cast<std::size_t>(skeleton.segments()[segment].branch);
            if (branch >= field_of_branch_.size()) field_of_branch_.resize(branch + 1, 0);
            field_of_branch_[branch] = static_cast<std::uint32_t>(n);
        }
    }
}

std::size_t SurfaceProjector::field_of(std::int32_t branch) const {
    const auto n = static_cast<std::size_t>(std::max(branch, 0));
    return n < field_of_branch_.size() ? field_of_branch_[n] : 0;
}

void SurfaceProjector::move(std::span<Point> points) const {
    if (fields_.empty()) return;
    std::vector<CubeOfPoint> cubes(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
        cubes[n] = cube_of(points[n], field_of(points[n].branch), static_cast<std::uint32_t>(n));
    });
    tbb::parallel_sort(cubes);
    // For each field, the segments that may reach any of its points.
    std::vector<Bounds<glm::dvec3>> boxes(fields_.size());
    for (const CubeOfPoint& cube : cubes)
        boxes[cube.field].hold(box_of(cube.block, kBlockBricks * cube.side(), cube.side()));
    std::vector<std::vector<std::uint32_t>> reaching(fields_.size());
    tbb::parallel_for(std::size_t{0}, fields_.size(), [&](std::size_t n) {
        reaching[n] = segments_reaching(fields_[n], fields_[n].skeleton().present(), boxes[n]);
    });
    const std::vector<std::size_t> blocks =
        stretches(cubes, [](const CubeOfPoint& a, const CubeOfPoint& b) { return a.same_block(b); });
    tbb::parallel_for(std::size_t{0}, blocks.size() - 1, [&](std::size_t b) {
        const std::span<const CubeOfPoint> block = std::span(cubes).subspan(blocks[b], blocks[b + 1] - blocks[b]);
        const CubeOfPoint& first = block.front();
        const Field& field = fields_[first.field];
        // Points move by less than a cell out of their bricks, and a cell is less than half a brick.
        const double around = 0.5 * first.side();
        const std::vector<std::uint32_t> near =
            segments_reaching(field, reaching[first.field], box_of(first.block, kBlockBricks * first.side(), around));
        BrickOfPoints work(field, points);
        const std::vector<std::size_t> bricks =
            stretches(block, [](const CubeOfPoint& a, const CubeOfPoint& c) { return a.same_brick(c); });
        for (std::size_t n = 0; n + 1 < bricks.size(); ++n) {
            const auto brick = block.subspan(bricks[n], bricks[n + 1] - bricks[n]);
            const std::vector<std::uint32_t> list =
                segments_reaching(field, near, box_of(brick.front().brick, first.side(), around));
            work.move(brick, list);
        }
    });
}

} // namespace ramus::field
