// The renderer's inside, shared by the files that implement it: passes/ draws, one pass or stage a file,
// renderer_picking.cpp answers what lies under a pixel, renderer.cpp is the public face.
#pragma once

#include "render/caster/caster.h"
#include "render/gl/bindings.h"
#include "render/gl/gl_context.h"
#include "render/gl/gl_objects.h"
#include "render/gpu/gpu_lines.h"
#include "render/gpu/gpu_mesh.h"
#include "render/gpu/gpu_shapes.h"
#include "render/gpu/gpu_skeleton.h"
#include "render/overlay/overlay.h"
#include "render/renderer/in_parts.h"
#include "render/renderer/renderer.h"
#include "render/renderer/uniform_blocks.h"
#include "render/scene/record_flags.h"

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::render {

// The uniform block of look.glsl.
struct LookBlock {
    glm::vec4 background_top, background_bottom, glass_colour, selection_colour, lights, more, line_colour,
        lesion_colour, lost_colour, far_colour, cues;
};
static_assert(sizeof(LookBlock) == sizeof(caster::Look));

// Ids less 1, as in ids.glsl: those of lesions are beyond every branch, those of context beyond every lesion.
inline constexpr int kFirstSolid = int{record::kSolid}, kFirstContext = int{record::kSolid | record::kContext};

// From mm to eye space with depth as +z, as the full-screen passes reckon.
glm::dmat4 eye_matrix(const Camera& camera);

// Of context meshes and of lesions: numbers from 1 on, as far as there are any.
inline constexpr std::size_t kMostNumbers = record::kNumberBits;
inline std::uint32_t number_of(std::size_t index) {
    return static_cast<std::uint32_t>(std::min(index + 1, kMostNumbers));
}
// Linear, with the opacity; negative: lines.
std::vector<glm::vec4> context_colours(const Frame& frame);

// Where parts of branches that are lost begin and end, as behind_cut() of scene.glsl reads it: five texels a part.
std::vector<glm::vec4> cut_places(const std::vector<LostPart>& lost, const Centerlines& lines, const glm::dmat4& eye);

// What the passes draw one view into, and what they know of it.
struct Passes {
    glm::ivec2 passes_{0};                            // their size
    Texture surface_, depth_;                         // multisampled
    Texture id_normal_, opaque_depth_, picked_depth_; // one value a pixel
    Texture covered_; // nearest depth a pixel: full-screen passes skip what is empty by testing against it
    Texture occlusion_, half_blurred_, blurred_, lit_;
    Framebuffer geometry_target_, glass_target_, resolve_target_, occlusion_target_, half_blur_target_, blur_target_,
        lit_target_;
    Buffer pane_heads_, panes_, pane_count_; // as in panes.glsl
    std::size_t head_room_ = 0, pane_room_ = 0;
    struct Band { // rows, in GL's sense of y, whose panes of glass fit into their bound together
        int first = 0, count = 0;
    };
    std::vector<Band> bands_; // of the last picture with glass; one: its lists are still there
    // Of glass without lists: the last layer and the one before, what they come to in front of each sample.
    Texture layer_panes_, fronts_;
    std::array<Texture, 2> layer_depths_;
    std::array<Framebuffer, 2> layer_targets_;
    Framebuffer fronts_target_;
    ViewBlock view_{};
    glm::dmat4 projection_{1.0}, mesh_to_clip_{1.0}; // of the last look_at()
    int shift_ = 0;                                  // which of kShifts the view is off by
};

// Full pictures are the mean of so many views, each off by less than a quarter of a pixel. The first one is what is
// pointed at.
inline constexpr int kFineViews = 4;

class Renderer::Impl : Passes {
public:
    Impl(std::size_t glass_bytes, std::size_t surface_bytes)
        : glass_bytes_(glass_bytes), surface_bytes_(surface_bytes) {}
    [[nodiscard]] std::size_t surface_bytes() const { return surface_bytes_; }
    Result<void> initialise();
    Result<DrawStatistics> draw(const Frame& wanted, std::size_t upload_budget, double seconds);
    Refined refine(double seconds);
    Image read_image() const;
    [[nodiscard]] unsigned texture() const { return picture_; }
    void present(unsigned framebuffer, int x, int y) const;
    BranchPicture read_branches();
    Pick pick(double x, double y);
    void request_pick(double x, double y);
    std::optional<Pick> poll_pick();

private:
    // The part of the picture around a pixel that a pick looks at.
    struct Window {
        glm::dvec2 at{0.0};
        double reach = 0.0;
        int x = 0, y = 0, width = 0, height = 0; // GL's sense of y
    };

    // A picture that is made in parts, while the last one is still there.
    struct Unfinished {
        Frame wanted, frame; // as draw() was given it, and as it is drawn
        std::vector<Layer> layers;
        std::optional<InParts<Result<std::uint64_t>>> geometry; // refers to frame and layers
        bool whole = false;                                     // that is: all but the shading
        double seconds = 0.0;                                   // that it has taken
        std::array<Fence, 3> fences;                            // behind the last parts: more would only queue up
    };

    Result<DrawStatistics> draw_all(const Frame& wanted, std::size_t upload_budget, double seconds);
    void let_go();
    enum class Targets { kPicture, kAll };
    Result<void> resize(glm::ivec2 size, Quality quality, Targets wanted);
    void make_passes(int samples);
    void add_to_sum();
    Result<bool> add_view(double seconds);
    Result<void> begin_refinement();
    Result<bool> add_views(double seconds);
    Result<Frame> take_up(const Frame& wanted, std::size_t upload_budget, DrawStatistics& done);
    Result<bool> fits(const Frame& wanted) const;
    [[nodiscard]] static std::size_t most_surface_bytes();
    InParts<Result<std::uint64_t>> draw_geometry(const Frame& frame, const GpuMesh* mesh,
                                                 const std::vector<Layer>& layers); // all must outlive it
    glm::dmat4 look_at(const Frame& frame, const Box& box);                         // fills view_; to clip from mm
    // Context meshes and lesions: passes/context.cpp. Each returns the number of triangles drawn.
    enum class Clear { kAll, kLesions };
    static bool has_lesions(const Frame& f) { return !f.lesions.spheres.empty() || !f.lesions.meshes.empty(); }
    std::uint64_t draw_solid_context(const Frame& frame) const;
    std::uint64_t list_clear_panes(const Frame& frame, Band band) const;
    std::uint64_t draw_clear_layer(const Frame& frame, Clear what, int layer) const;
    std::uint64_t draw_first_clear_layer(const Frame& frame, Clear what, std::size_t target) const;
    using Prepare = std::function<void(const Program&)>;
    std::uint64_t draw_clear(const Frame& frame, Clear what, const Prepare& prepare) const;
    std::uint64_t draw_clear_context(const Frame& frame, const Prepare& prepare) const;
    std::uint64_t draw_lesions(const Frame& frame, const Prepare& prepare) const;
    InParts<Result<std::uint64_t>> draw_glass(const Frame& frame, const GpuMesh& mesh);
    InParts<std::size_t> list_panes(const Frame& frame, const GpuMesh& mesh, Band band, std::uint64_t& triangles);
    // Where there are no lists: passes/peeling.cpp.
    void make_layers();
    void find_sample_places();
    void draw_by_sample(const Program& program, const std::function<void()>& draw) const;
    enum class LayerOf { kVessels, kEverything };
    bool draw_layer(const Frame& frame, const GpuMesh& mesh, int layer, LayerOf what, std::uint64_t& triangles);
    std::uint64_t draw_first_layer(const Frame& frame, const GpuMesh& mesh);
    Result<void> peel(const Frame& frame, const GpuMesh& mesh, unsigned variant);
    bool make_room_for_panes(std::size_t wanted);
    void bind_panes(const Program& program, Band band) const;
    [[nodiscard]] bool casts(const Frame& frame) const; // whether the caster can draw it
    void add_bodies(const Frame& frame, caster::Meaning& meaning) const;
    std::uint64_t cast(const Frame& frame, const std::vector<Layer>& layers);
    LookBlock look_of(const Frame& frame, bool outlined) const;
    std::uint64_t draw_cones(const Frame& frame, const std::vector<Layer>& layers);
    static void end_borders();
    void take_front_faces(bool write_depth) const;
    void clear_samples() const;
    void send_layers(const PagedMesh& mesh, const std::vector<Layer>& layers);
    InParts<std::uint64_t> draw_surface(const Frame& frame, const GpuMesh& mesh,
                                        const std::vector<Layer>& layers) const;
    void resolve(Band band);
    void resolve_by(const Program& program, Band band);
    void draw_occlusion(const Frame& frame);
    // What shade.frag is told, and which of its variants: bits of Variant.
    enum Variant : unsigned {
        kGlass = 1,
        kOutline = 2,
        kShadows = 4,
        kMargins = 8,
        kScale = 16,
        kCuts = 32,
        kOnlyChanged = 64,
        kHalos = 128,
        kContours = 256,
        kChromadepth = 512,
        kLayer = 1024,
        kContext = 2048,
    };
    enum class Extent { kAll, kChanged }; // the picture, or the branches that the last one showed otherwise
    unsigned send_records(const Frame& frame, const GpuMesh* mesh, Extent extent);
    unsigned send_scene(const Frame& frame);
    Result<const Program*> shading(unsigned variant);
    // The part of the picture that branches marked in `changed` can be seen in, or more.
    void find_region(const Frame& frame, const PagedMesh& mesh, const std::vector<std::uint8_t>& changed);
    Result<void> shade(const Frame& frame, const GpuMesh* mesh, Extent extent);
    void draw_overlays(const Frame& frame, const std::vector<Layer>& layers);
    void draw_skeleton(const Frame& frame, const std::vector<Layer>& layers);
    void send_cast_depths() const;
    void draw_marks(const Frame& frame);

    enum class Pixels { kAll, kCovered };
    void fullscreen(const Program& program, Pixels pixels = Pixels::kAll) const;
    void begin_state() const;
    void restore_state() const;
    // What the passes drew into is being drawn anew: who asks what is there waits for that, or gets no answer.
    [[nodiscard]] bool between_pictures() const { return unfinished_ && !cast_; }
    void finish();
    [[nodiscard]] static bool draw_parts(Unfinished& picture, double seconds);
    [[nodiscard]] bool same_geometry(const Frame& a, const Frame& b) const;
    Window pick_window(double x, double y) const;
    Pick nearest_in(const Window& window, const std::uint32_t* ids, const float* depths, const Camera& camera) const;

    Program geometry_, border_, cone_, fragment_, border_fragment_, centerline_, resolve_, resolve_glass_,
        resolve_lesions_, occlude_, blur_, background_, enlarge_, overlay_, mark_, context_, clear_context_,
        context_lines_, skeleton_line_, skeleton_ring_;
    std::map<unsigned, Program> shade_;                 // by variant, made when needed
    std::vector<std::array<std::uint16_t, 4>> records_; // of the last picture's branches
    glm::ivec2 region_at_{0}, region_size_{0};          // that is shaded, of `inner_`, in GL's sense of y
    VertexArray no_vertices_;
    Buffer view_block_, look_block_, scene_block_, branch_buffer_, lesion_buffer_, cut_buffer_, context_buffer_,
        layer_buffer_;
    Texture branch_texture_, lesion_texture_, cut_texture_, context_texture_, ramp_texture_, distance_texture_,
        layer_texture_;
    std::size_t branch_capacity_ = 0, lesion_capacity_ = 0, cut_capacity_ = 0, context_capacity_ = 0,
                layer_capacity_ = 0;
    std::shared_ptr<const DistanceGrid> distances_; // in distance_texture_

    glm::ivec2 size_{0};  // of the picture
    glm::ivec2 inner_{0}; // of what is drawn, smaller while the view moves
    Texture picture_;
    Framebuffer picture_target_;
    bool has_glass_ = false; // or context that is clear, or lesions
    caster::Caster caster_;
    bool cast_ = false;       // the last picture is the caster's, not the passes'
    bool holds_last_ = false; // what the passes drew into holds the last picture
    std::unique_ptr<Unfinished> unfinished_;
    // The last picture as the mean of several views.
    struct Refinement {
        int views = 0; // that are in the sum
        Passes passes; // that the next one is drawn into
        std::unique_ptr<Unfinished> next;
        Texture sum; // linear light
        Framebuffer sum_target;
    };
    std::unique_ptr<Refinement> refinement_;
    bool refined_ = false;     // the last picture is as fine as it gets
    bool lit_is_mean_ = false; // of several views, and not the first one
    Program add_view_, mean_view_;
    bool moving_ = false;                          // another camera on the same surface, in a hurry
    std::shared_ptr<const PagedMesh> wanted_mesh_; // of the last frame, there or not
    std::vector<Layer> layers_;                    // by branch, all of them: in layer_texture_
    std::size_t glass_bytes_;                      // that panes may take
    std::size_t surface_bytes_;                    // that surfaces may
    Query layer_query_;
    std::array<glm::vec2, kMostSamples> sample_places_{};

    GpuMesh mesh_, preview_;
    const GpuMesh no_mesh_;
    GpuLines lines_;
    GpuSkeleton skeleton_;
    GpuShapes shapes_;
    const GpuMesh* drawn_ = nullptr; // the one of the last picture; null: nothing

    std::vector<Sprite> sprites_;
    std::optional<SpriteSource> sprites_of_;
    std::optional<Frame> last_;
    std::vector<Layer> last_layers_;

    Buffer pick_buffer_;
    GLsizeiptr pick_buffer_size_ = 0;
    std::optional<Fence> pick_fence_; // behind the last request
    Window pick_window_;
    std::optional<Pick> pick_answer_; // there already
    Camera pick_camera_;
};

} // namespace ramus::render
