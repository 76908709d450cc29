// Caster: draws pictures of vessels on the processor's cores while the view moves, for machines where OpenGL is
// software.
//
// It casts rays at round cones along the centerlines, as cone.frag does, with the samples, the occlusion and the light
// of the picture at rest. Where a ray hits a cone, the field of the convolution surface gives the normal, so that forks
// and bends look smooth. Each step processes a vector of pixels, with the instruction set chosen at run time; tiles run
// in parallel. A picture of full size and quality takes about the time that a software rasteriser needs for half the
// size.
//
// Guarantees: pictures do not depend on the number of threads. Not guaranteed: that it can draw every frame; draws()
// tells, and OpenGL draws the others. One Caster must be used by one thread at a time.
#pragma once

#include "render/caster/bins.h"
#include "render/caster/cast_types.h"
#include "render/caster/slices.h"
#include "render/caster/thick_vessels.h"
#include "render/caster/triangles.h"
#include "render/caster/vessel_cones.h"
#include "render/scene/frame.h"
#include "render/scene/layer.h"
#include "render/scene/look_data.h"
#include "render/scene/paged_mesh.h"

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

namespace ramus::render::caster {

// What a picture shows and how it looks. Its references must stay valid during draw().
struct Content {
    const Uniforms& uniforms;
    bool outlined;                                            // something is selected
    const std::vector<Layer>& layers;                         // by branch
    const std::vector<std::array<std::uint16_t, 4>>& records; // by branch: linear colour and flags, as in ids.glsl
    const LookData& data;
    const std::vector<Body>& bodies; // lesions with meshes, and context
    const PagedMesh* surface;        // the vessels' surface at rest; null: not available
    glm::dmat4 surface_to_clip;      // from positions relative to its origin
    const PlanesBlock& planes;       // of the frame's planes
};

class Caster {
public:
    // See VesselCones::follow().
    void follow(const Frame& frame, const std::shared_ptr<const FittedCones>& known) { vessels_.follow(frame, known); }
    [[nodiscard]] const std::shared_ptr<const FittedCones>& fitted() const { return vessels_.fitted(); }

    // Whether the caster can draw everything that the frame shows.
    [[nodiscard]] static bool draws(const Frame& frame);

    // Draws the picture, which rgba(), ids() and depths() then return until the next call. `to_eye`: from mm to eye
    // space, depth as +z. Returns the number of visible cones.
    std::size_t draw(const Frame& frame, const View& view, const glm::dmat4& to_eye, const Content& content);
    [[nodiscard]] const std::uint32_t* rgba() const { return rgba_.data(); } // sRGB, premultiplied, rows from below

    // Of the last picture: ids as in ids.glsl, and depths in mm; rows `stride()` apart, from below.
    [[nodiscard]] const std::uint32_t* ids() const { return ids_.data() + kTile; }
    [[nodiscard]] const float* depths() const { return picked_.data() + kTile; }
    [[nodiscard]] int stride() const { return view_.stride; }

private:
    // Records that a tile keeps between casting and shading.
    struct KeptRecords {
        std::vector<std::uint32_t> position, id, normal;
        std::vector<float> depth, value; // value: empty if surfaces have no values
        std::size_t count = 0;

        void keep(const Records& records);
        [[nodiscard]] Records view();
    };
    struct Tile {
        KeptRecords opaque, glass;
        std::vector<SlicePixel> slices;
    };
    struct Binned {
        Bins opaque, glass, solid_triangles, clear_triangles;
    };
    struct Scratches; // working memory of the threads

    // The steps of a picture.
    void resize(const View& view);
    [[nodiscard]] Binned bin() const;
    void cast(int tile, const Binned& binned, const Slicer& slicer, bool with_values);
    void occlude();
    [[nodiscard]] Shading shading_of(const Frame& frame, const Content& content) const;
    [[nodiscard]] std::vector<std::uint8_t> tiles_with_outline(const Content& content) const;
    void shade(const Shading& shading, const std::vector<std::uint8_t>& outlined);
    template <class Call> void for_tiles(const Call& call) const; // in parallel, call(tile)
    [[nodiscard]] int left(int tile) const { return tile % across_ * kTile; }
    [[nodiscard]] int low(int tile) const { return tile / across_ * kTile; }

    VesselCones vessels_;
    ConeList cones_;
    std::vector<Triangle> solid_triangles_, clear_triangles_;

    View view_;
    int across_ = 0, up_ = 0; // tiles
    std::vector<Tile> tiles_;
    std::vector<float> depths_, depth_planes_, picked_;
    std::vector<float> rough_sky_, smooth_sky_, rough_key_, smooth_key_; // see PictureArrays
    std::vector<std::uint32_t> ids_, normals_;
    std::vector<std::uint32_t> rgba_; // one per pixel
    PictureArrays picture_{};
    std::shared_ptr<Scratches> scratches_;
};

} // namespace ramus::render::caster
