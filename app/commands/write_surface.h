// A tree's surface, made and written: as a whole, or streamed to the disk when it is more than memory holds. The file
// is the same either way.
#pragma once

#include "core/base/error.h"
#include "core/mesh/surface.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace ramus::app {

struct WrittenSurface {
    std::uint64_t vertices = 0, triangles = 0, evaluations = 0;
    int components = 0;
    bool streamed = false;
    double mesh_s = 0.0, write_s = 0.0;
};

// Shows a progress bar; an interrupt cancels it.
[[nodiscard]] Result<WrittenSurface> write_surface(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                                                   std::span<const std::uint8_t> hidden,
                                                   const std::filesystem::path& output);

} // namespace ramus::app
