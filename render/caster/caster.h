// Caster: pictures of vessels while the view moves, made on the processor's own cores where OpenGL is software. Rays
// are cast at round cones along the centerlines, as cone.frag does it, with the samples, the occlusion and the light of
// the picture at rest; where they hit a cone, the field of the convolution surface gives its normal, so that
// forks and bends look as smooth as they are. A vector of pixels goes through each step at once (run-time choice of
// instruction set), tiles in parallel. In the time that a software rasteriser takes for a picture of half the size this
// makes one of full size and quality. Pictures are the same whatever the number of threads.
//
// What it cannot draw stays with OpenGL: see Caster::draws().
#pragma once

#include "render/caster/bins.h"
#include "render/caster/cast_types.h"
#include "render/caster/neighbours.h"
#include "render/caster/triangles.h"
#include "render/scene/centerlines.h"
#include "render/scene/frame.h"
#include "render/scene/layer.h"
#include "render/scene/look_data.h"

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

namespace ramus::render::caster {

// What a picture shows and how it looks. Only referred to.
struct Content {
    const Uniforms& uniforms;
    bool outlined;                                            // something is selected
    const std::vector<Layer>& layers;                         // of branches
    const std::vector<std::array<std::uint16_t, 4>>& records; // of branches: linear colour and flags, as in ids.glsl
    const LookData& data;
    const std::vector<Body>& bodies; // lesions that are meshes, and context
};

class Caster {
public:
    // Of the lines as they are; those of one object are the same for good. `as_field`: the surface is that of a field
    // around them, not round cones.
    void follow(const std::shared_ptr<const Centerlines>& lines, bool as_field);

    // Whether it can draw all that the frame shows.
    [[nodiscard]] static bool draws(const Frame& frame);

    // The picture as sRGB, premultiplied, rows from below; it lasts until the next. `to_eye`: from mm to eye space,
    // depth as +z. Returns how many cones.
    std::size_t draw(const Frame& frame, const View& view, const glm::dmat4& to_eye, const Content& content);
    [[nodiscard]] const std::uint32_t* rgba() const { return rgba_.data(); }

    // Of the last picture: ids as in ids.glsl and depths in mm, `stride` a row from below.
    [[nodiscard]] const std::uint32_t* ids() const { return ids_.data() + kTile; }
    [[nodiscard]] const float* depths() const { return picked_.data() + kTile; }
    [[nodiscard]] int stride() const { return view_.stride; }

private:
    struct Segment {
        std::uint32_t point; // and the next one
        std::int32_t branch;
        // Points that the vessel comes from and goes on to; or one of these.
        static constexpr std::uint32_t kFree = ~0U, kJoins = ~0U - 1; // ends here; goes into another vessel here
        std::uint32_t previous, next;
    };
    // What lasts from picture to picture: of the lines, of the surface's width, of what is in glass.
    void find_joints();
    void follow_width(const Frame& frame);
    void fit_cones(float width, float beyond_ends);
    void fit_to_field();
    void find_mixed_layers(const std::vector<Layer>& layers);
    [[nodiscard]] FieldSegment field_segment_of(const Segment& segment, const glm::mat4& to_eye) const;
    enum class Kind : std::uint8_t { kNone, kOpaque, kGlass };
    // What a tile keeps from casting to shading.
    struct KeptRecords {
        std::vector<std::uint32_t> position, id, normal;
        std::vector<float> depth, value; // value: empty where there is none
        std::size_t count = 0;

        void keep(const Records& records);
        [[nodiscard]] Records view();
    };
    struct Tile {
        KeptRecords opaque, glass;
    };
    struct Binned {
        Bins opaque, glass, solid_triangles, clear_triangles;
    };
    struct Scratches; // what threads work in

    void resize(const View& view);
    // These fill in a cone in eye space; false: there is nothing of it to see. The first one's ends are those of
    // `points`.
    [[nodiscard]] bool prepare(const Segment& segment, const glm::mat4& to_eye, const Frame& frame,
                               const std::vector<glm::vec4>& points, RoundCone& cone) const;
    [[nodiscard]] bool prepare_line(const Segment& segment, const glm::mat4& to_eye, const Frame& frame,
                                    RoundCone& cone) const;
    [[nodiscard]] bool prepare_ball(const glm::vec4& sphere, std::uint32_t id, RoundCone& cone) const;
    static void set_radii(RoundCone& cone, float first, float last); // and what follows from them; its axis is there
    // The steps of a picture. The first places cones for opaque vessels, for glass and for the lines inside it, and
    // returns how many.
    std::size_t prepare_vessels(const Frame& frame, const glm::dmat4& to_eye, const std::vector<Layer>& layers);
    void prepare_lesions(const std::vector<glm::vec4>& spheres);
    [[nodiscard]] Binned bin() const;
    void cast(int tile, const Binned& binned, bool with_values);
    void occlude();
    [[nodiscard]] Shading shading_of(const Frame& frame, const Content& content) const;
    [[nodiscard]] std::vector<std::uint8_t> tiles_with_outline(const Content& content) const;
    void shade(const Shading& shading, const std::vector<std::uint8_t>& outlined);
    template <class Call> void for_tiles(const Call& call) const; // in parallel, call(tile)
    [[nodiscard]] int left(int tile) const { return tile % across_ * kTile; }
    [[nodiscard]] int low(int tile) const { return tile / across_ * kTile; }

    std::shared_ptr<const Centerlines> lines_;
    bool as_field_ = false;
    Centerlines thinned_;
    std::vector<std::uint32_t> coincident_; // of its points: coincident_points()
    // By point of those: the ball around it that is nearest to the surface; and where the point itself is.
    std::vector<glm::vec4> fitted_, on_line_;
    // By segment; those that the field reads have one more, which is nowhere.
    std::vector<Segment> segments_;
    std::vector<std::uint32_t> segment_branches_;
    Neighbours neighbours_;
    float neighbours_width_ = 0.0F;                   // of the kernel that those are for; 0: of none
    float fitted_width_ = -1.0F, fitted_ends_ = 0.0F; // of the frame that all that is for
    std::vector<Layer> layers_, segment_layers_;      // by branch; by segment
    Neighbours other_layer_;                          // of the neighbours those of another layer
    std::vector<FieldSegment> field_segments_;        // none: the surface is cones
    Field field_{};

    std::vector<RoundCone> cones_;
    std::vector<Kind> kinds_; // of them
    std::vector<Triangle> solid_triangles_, clear_triangles_;

    View view_;
    int across_ = 0, up_ = 0; // tiles
    std::vector<Tile> tiles_;
    std::vector<float> depths_, depth_planes_, picked_, occlusion_, smoothed_;
    std::vector<std::uint32_t> ids_, normals_;
    std::vector<std::uint32_t> rgba_; // a pixel each
    PictureArrays picture_{};
    std::shared_ptr<Scratches> scratches_;
};

} // namespace ramus::render::caster
