// Renderer: draws a Frame into a framebuffer of its own, the same way for the window and without one, and answers what
// lies under a pixel. It keeps the last frame's meshes on the graphics card and sends only pages that changed; a change
// of states, colours, hover or selection draws no triangle again, a frame equal to the last one draws nothing.
//
// All calls need the GL context current that was current at create(), the destructor too. Pixels have their origin at
// the top left.
#pragma once

#include "core/base/error.h"
#include "render/image/image.h"
#include "render/scene/frame.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
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

class Renderer {
public:
    [[nodiscard]] static Result<std::unique_ptr<Renderer>> create(std::size_t glass_bytes = kGlassBytes,
                                                                  std::size_t surface_bytes = kMostOfGraphicsMemory);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    [[nodiscard]] std::size_t surface_bytes() const; // that surfaces may take

    // Makes the picture of `frame` the current one. Fails on an impossible size or when memory runs out. With a limit
    // in seconds a picture in full quality may take several calls, which each go on where the one before stopped as
    // long as camera, surface, states and size stay; and the limit is passed by a part that takes long.
    [[nodiscard]] Result<DrawStatistics> draw(const Frame& frame, std::size_t upload_budget = kUploadAll,
                                              double seconds = kUntilDone);

    // Makes the current picture finer, where it is a full one that OpenGL has drawn: edges and occlusion of sixteen
    // samples a pixel in place of four, in the time of three more pictures, as many calls as that takes. What is under
    // its pixels stays as it is. The next draw() of another frame begins anew; memory that there is not is no error.
    Refined refine(double seconds = kUntilDone);

    // The current picture. Straight alpha when the background is transparent.
    [[nodiscard]] Image read_image();
    // The same as a texture: sRGB, premultiplied, rows from below. It is another one after a draw() of another size.
    [[nodiscard]] unsigned texture() const;
    // What every pixel of the current picture shows, as pick() sees it; waits for the GPU.
    [[nodiscard]] BranchPicture read_branches();
    // Copies the current picture into `framebuffer` (0 = the window's), its lower left corner at (x, y) in GL's sense.
    // Changes the bound draw framebuffer to that one. The picture's own pixels stay as they are: draw the interface
    // there.
    void present(unsigned framebuffer, int x = 0, int y = 0);

    // Nearest vessel within the pick radius of pixel (x, y) of the current picture; waits for the GPU.
    [[nodiscard]] Pick pick(double x, double y);
    // The same without waiting, for hovering: ask now, look every frame until an answer is there. A newer request
    // replaces an older one.
    void request_pick(double x, double y);
    [[nodiscard]] std::optional<Pick> poll_pick();

private:
    class Impl;
    explicit Renderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

struct PictureTarget;

// A colour framebuffer without a window, RGBA8: what present() needs when the interface is drawn headlessly.
class Target {
public:
    Target(int width, int height); // throws OutOfGraphicsMemory (render/gl/gl_objects.h)
    ~Target();
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
    [[nodiscard]] unsigned framebuffer() const;
    [[nodiscard]] Image read_image() const;

private:
    std::unique_ptr<PictureTarget> picture_;
};

} // namespace ramus::render
