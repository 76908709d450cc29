// AlongPainter: draws an AlongView without GL: the scans along the vessel, its walls as lines in the colours of the
// branches, distances along the axis, the current place and the stretches of a stenosis. Keeps the sampled values and
// the walls of the last picture. Not thread-safe.
#pragma once

#include "core/slice/walls.h"
#include "render/image/image.h"
#include "render/scene/frame.h"
#include "render/slice/sampled_layers.h"
#include "render/slice/slice_view.h"

#include <memory>
#include <optional>
#include <vector>

namespace ramus::render {

class AlongPainter {
public:
    // Draws into an opaque picture of `view.grid.size` pixels. Requires `view.along`.
    void paint(const Frame& frame, const SliceView& view, Image& image);

private:
    void follow(const AlongView& along);
    void paint_scans(const SliceView& view, Image& image);
    void paint_walls(const Frame& frame, const SliceView& view, Image& image);

    AlongView of_; // what determines the reformation; without looks
    std::optional<slice::Reformation> picture_;
    SampledLayers sampled_;
    slice::Sampling sampled_by_;
    std::optional<slice::Walls> walls_;
    std::shared_ptr<const std::vector<std::optional<slice::Lumen>>> walls_of_; // the lumina that they are of
};

// The walls of one part of the way, as lines in columns and rows.
[[nodiscard]] std::vector<slice::Outline> wall_lines_of(const slice::VesselPath& path, const slice::PathPart& part,
                                                        const slice::Reformation& picture, slice::Walls walls);

// By branch: whether the outer loop of a lumen goes over it. `mesh`: that the lumina are of.
[[nodiscard]] std::vector<char> branches_around(const std::vector<std::optional<slice::Lumen>>& lumens,
                                                const PagedMesh& mesh);
// The walls of a reformation from a surface in pages, a line for each row. Only the surface of `branches` counts:
// other vessels may reach into the lumen.
[[nodiscard]] slice::Walls walls_of(const slice::Reformation& picture, const PagedMesh& mesh,
                                    const std::vector<char>& branches);

} // namespace ramus::render
