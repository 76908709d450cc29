// What a Renderer tells of what it has drawn, and how much it may draw.
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
    int lesion = kNoLesion;   // of the frame's spheres, then its meshes; kNoLesion: none there
    glm::dvec3 position{0.0}; // mm, on the surface; meaningless without a branch or a lesion
    bool operator==(const Pick&) const = default;
};

// The branch that each pixel shows, row by row from the top left.
struct BranchPicture {
    int width = 0, height = 0;
    std::vector<int> branches; // kNoBranch: none
    // Of the pixel that has this point in it; kNoBranch outside of the picture.
    [[nodiscard]] int at(double x, double y) const {
        if (!(x >= 0.0 && y >= 0.0 && x < width && y < height)) return kNoBranch;
        return branches[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

// What the last draw() did, for --benchmark, --verbose and tests.
struct DrawStatistics {
    std::uint64_t triangles = 0; // sent to the GPU
    std::uint64_t cones = 0;     // cast at on the processor, in place of triangles
    bool geometry = false;       // triangles were drawn (else the last geometry was shaded again)
    bool shaded = false;         // false: the frame was the same as the one before
    std::uint64_t uploaded = 0;  // bytes of meshes sent to the GPU
    bool pending = false;        // the frame's mesh is not all there yet: its preview was drawn, or the mesh before it.
                                 // Draw again.
    bool unfinished = false;     // it would have taken longer than it may: the picture is the one before. Draw again.
    bool of_before = false;      // what is shown was begun by a call before, and is of another tree's centerlines
    double seconds = 0.0;        // that the picture has taken, all calls together
    bool coarse = false;         // the preview was drawn, because graphics memory does not hold the mesh
    Quality quality = Quality::kFull; // that it was drawn in: quick while only the preview is there
};

struct Refined {
    bool more = false;    // there is more to be gained: call again
    bool changed = false; // the picture is another one than before
};

// How much of a mesh a draw() may send, in bytes. A large mesh then comes over several frames, none of which waits.
inline constexpr std::size_t kUploadAll = std::numeric_limits<std::size_t>::max();

inline constexpr double kUntilDone = std::numeric_limits<double>::infinity();

// The largest picture: neither side beyond kLargestSide, nor more than kLargestArea pixels.
inline constexpr int kLargestSide = 16384;
inline constexpr std::int64_t kLargestArea = 36 * 1024 * 1024;
[[nodiscard]] Result<void> check_size(std::int64_t width, std::int64_t height);

inline constexpr int kPickRadius = 4; // pixels (times Frame::pixel_ratio) that a thin vessel may be missed by

// What the lists of glass may take of the graphics card's memory, twice while a picture is refined. Pictures that would
// need more are drawn in bands, in more time and with the same pixels.
inline constexpr std::size_t kGlassBytes = std::size_t{512} << 20;

// What surfaces may take of it. One that takes more is seen by its preview; without one that fits, draw() fails.
inline constexpr std::size_t kMostOfGraphicsMemory = 0; // three quarters of what there is

} // namespace ramus::render
