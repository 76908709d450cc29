// Results and limits of a Renderer: picks, statistics, budgets, sizes.
#pragma once

#include "core/base/error.h"
#include "render/scene/frame.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace ramus::render {

inline constexpr int kNoLesion = -1;

struct Pick {
    int branch = kNoBranch;   // kNoBranch: no vessel there
    int lesion = kNoLesion;   // index into the frame's spheres, then meshes; kNoLesion: none there
    glm::dvec3 position{0.0}; // mm, on the surface; meaningless without a branch, a lesion or a plane
    int plane = kNoPlane;     // index into the frame's planes; kNoPlane: none, or a vessel or a lesion is before it
    bool operator==(const Pick&) const = default;
};

// The branch at each pixel, row by row from the top left.
struct BranchPicture {
    int width = 0, height = 0;
    std::vector<int> branches; // kNoBranch: none
    // The branch of the pixel that contains the point; kNoBranch outside the picture.
    [[nodiscard]] int at(double x, double y) const {
        if (!(x >= 0.0 && y >= 0.0 && x < width && y < height)) return kNoBranch;
        return branches[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

// What the last draw() did, for --benchmark, --verbose and tests.
struct DrawStatistics {
    std::uint64_t triangles = 0;      // sent to the GPU
    std::uint64_t cones = 0;          // cast by the ray caster in place of triangles
    bool geometry = false;            // triangles were drawn; false: the last geometry was shaded again
    bool shaded = false;              // false: the frame was the same as the one before
    std::uint64_t uploaded = 0;       // bytes of meshes sent to the GPU
    bool pending = false;             // the mesh is not completely sent: its preview or the previous mesh was drawn.
                                      // Draw again.
    bool unfinished = false;          // the time limit stopped it: the picture is the previous one. Draw again.
    bool of_before = false;           // the picture was begun by an earlier call and shows another tree's centerlines;
                                      // of a sheet, also: a view shows an earlier picture, or none
    double seconds = 0.0;             // time for the picture, over all calls
    bool coarse = false;              // the preview was drawn because the mesh exceeds graphics memory
    Quality quality = Quality::kFull; // actual quality: interactive while only the preview is sent
};

struct Refined {
    bool more = false;    // not complete: call again
    bool changed = false; // the picture changed
};

// Upload budget of a draw(), in bytes. With a limit, a large mesh arrives over several frames, none of which waits.
inline constexpr std::size_t kUploadAll = std::numeric_limits<std::size_t>::max();

inline constexpr double kUntilDone = std::numeric_limits<double>::infinity();

// The largest picture: each side at most kLargestSide, at most kLargestArea pixels.
inline constexpr int kLargestSide = 16384;
inline constexpr std::int64_t kLargestArea = 36 * 1024 * 1024;
[[nodiscard]] Result<void> check_size(std::int64_t width, std::int64_t height);

inline constexpr int kPickRadius = 4; // pixels (times Frame::pixel_ratio) by which a click may miss a thin vessel

// Largest size of the fragment lists of glass in graphics memory; twice that during refinement. Larger pictures are
// drawn in bands: slower, with the same pixels.
inline constexpr std::size_t kGlassBytes = std::size_t{512} << 20;

// Largest size of surfaces in graphics memory. A larger surface is shown by its preview; draw() fails if no preview
// fits.
inline constexpr std::size_t kMostOfGraphicsMemory = 0; // 0: three quarters of graphics memory

} // namespace ramus::render
