// Divides a surface by a value of its vertices, for drawing bands of colour with sharp borders.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <span>
#include <vector>

namespace ramus::mesh {

// The parts of the mesh where the value, linear in each triangle, is up to limits[0], between neighbouring limits, and
// above the last: one more than there are limits. `values`: by vertex; `limits`: ascending. The parts have positions,
// normals and triangles, and share vertices neither within nor between them.
[[nodiscard]] std::vector<TriangleMesh> value_bands(const TriangleMesh& mesh, std::span<const float> values,
                                                    std::span<const double> limits);

} // namespace ramus::mesh
