#include "core/base/stopwatch.h"
#include "render/renderer/finished_picture.h"
#include "render/renderer/renderer_impl.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace ramus::render {

namespace {

Layer layer_of(BranchState state) {
    if (state == BranchState::kHidden) return Layer::kNone;
    return state == BranchState::kDefocused ? Layer::kGlass : Layer::kOpaque;
}

} // namespace

Result<void> Renderer::Impl::initialise() {
    const auto make = [](Program& program, std::string_view vertex, std::string_view fragment,
                         std::string_view defines = {}, std::string_view geometry = {}) -> Result<void> {
        auto made = make_program(vertex, fragment, defines, geometry);
        if (!made) return tl::unexpected(made.error());
        program = std::move(*made);
        return {};
    };
    for (auto [program, vertex, fragment] : {std::tuple{&geometry_, "geometry.vert", "geometry.frag"},
                                             {&cone_, "cone.vert", "cone.frag"},
                                             {&resolve_, "fullscreen.vert", "resolve.frag"},
                                             {&occlude_, "fullscreen.vert", "occlusion.frag"},
                                             {&blur_, "fullscreen.vert", "occlusion_blur.frag"},
                                             {&background_, "fullscreen.vert", "background.frag"},
                                             {&enlarge_, "fullscreen.vert", "enlarge.frag"},
                                             {&add_view_, "fullscreen.vert", "add_view.frag"},
                                             {&mean_view_, "fullscreen.vert", "mean_view.frag"},
                                             {&overlay_, "fullscreen.vert", "overlay.frag"},
                                             {&mark_, "mark.vert", "mark.frag"},
                                             {&context_, "context.vert", "context.frag"}})
        if (auto made = make(*program, vertex, fragment); !made) return made;
    const char* const glass = gl_has_lists() ? "fragment_list.frag" : "fragment_layer.frag";
    for (auto [program, vertex, fragment, defines, geometry] :
         {std::tuple{&border_, "geometry.vert", "geometry.frag", "#define BORDER\n", "border.geom"},
          {&fragment_, "geometry.vert", glass, "#define TRANSPARENT\n", ""},
          {&border_fragment_, "geometry.vert", glass, "#define TRANSPARENT\n#define BORDER\n", "border.geom"},
          {&clear_context_, "context.vert", "context.frag", "#define TRANSPARENT\n", ""},
          {&context_lines_, "context.vert", "context.frag", "#define TRANSPARENT\n#define LINES\n", ""},
          {&resolve_glass_, "fullscreen.vert", "resolve.frag", "#define GLASS\n", ""},
          {&centerline_, "centerline.vert", "geometry.frag", "#define LINE\n", ""}})
        if (auto made = make(*program, vertex, fragment, defines, geometry); !made) return made;
    constexpr const char* kOfLesions = "#define GLASS\n#define LESIONS\n";
    if (!gl_has_lists())
        if (auto made = make(resolve_lesions_, "fullscreen.vert", "resolve.frag", kOfLesions); !made) return made;
    if (surface_bytes_ == kMostOfGraphicsMemory) surface_bytes_ = most_surface_bytes();
    no_vertices_ = make_vertex_array();
    view_block_ = make_buffer(sizeof(ViewBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    look_block_ = make_buffer(sizeof(LookBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    scene_block_ = make_buffer(sizeof(SceneBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    return {};
}

// Draws over every pixel, or only where a surface is: the early depth test is the one branch that a software rasteriser
// really skips. The triangle lies at depth 0, the far plane.
void Renderer::Impl::fullscreen(const Program& program, Pixels pixels) const {
    if (pixels == Pixels::kCovered) {
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_LESS);
    }
    glUseProgram(program);
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
}

// OpenGL's own defaults, for whoever draws next, and wherever a picture stops.
void Renderer::Impl::restore_state() const {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    glBindVertexArray(0);
    glUseProgram(0);
    for (GLuint unit = 0; unit < kUnits; ++unit) glBindTextureUnit(unit, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

namespace {

bool differs_in_hover_only(const Frame& before, const Frame& after) {
    Frame same = before;
    same.hovered = after.hovered;
    same.hovered_dependents = after.hovered_dependents;
    return same == after;
}

// Colours, and how clear what is clear is, only shade.
bool same_shapes(const std::vector<ContextMesh>& a, const std::vector<ContextMesh>& b) {
    const auto shape = [](const ContextMesh& m) {
        return std::tuple(m.shown() ? m.mesh : nullptr, m.shown() ? m.preview : nullptr, m.clear(), m.wireframe);
    };
    return std::ranges::equal(a, b, {}, shape, shape);
}

} // namespace

// Memory may run out in any pass: then nothing is kept of the picture and of what was sent for it, so that the next
// draw(), perhaps of less, begins with what was there before the first.
Result<DrawStatistics> Renderer::Impl::draw(const Frame& wanted, std::size_t upload_budget, double seconds) {
    if (auto fits = check_size(wanted.size.x, wanted.size.y); !fits) return tl::unexpected(fits.error());
    try {
        return draw_all(wanted, upload_budget, seconds);
    } catch (const OutOfGraphicsMemory& error) {
        let_go();
        return fail(error.what(), {}, "give a smaller size or a coarser --detail");
    }
}

// Whether the passes up to the occlusion would make the same of both, where all else is the same.
bool Renderer::Impl::same_geometry(const Frame& a, const Frame& b) const {
    return a.mesh == b.mesh && a.camera == b.camera && a.size == b.size && a.quality == b.quality &&
           a.lesions == b.lesions && same_shapes(a.context, b.context) && a.pixel_ratio == b.pixel_ratio &&
           (!has_glass_ || a.centerlines == b.centerlines) &&
           (a.appearance.occlusion > 0.0F || !(b.appearance.occlusion > 0.0F));
}

// Whatever others have left.
void Renderer::Impl::begin_state() const {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glViewport(0, 0, inner_.x, inner_.y);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockView, view_block_);
}

// Parts of an unfinished picture, one at least, until the time is over; true: only the shading is left, and the time
// for it there.
bool Renderer::Impl::draw_parts(Unfinished& picture, double seconds) {
    const Stopwatch watch;
    const bool at_once = seconds == kUntilDone;
    bool worked = false;
    while (!picture.whole) {
        if (worked && watch.seconds() >= seconds) return false;
        if (!at_once && !picture.fences[0].passed(seconds - watch.seconds())) return false;
        picture.whole = !picture.geometry->resume();
        worked = true;
        if (at_once) continue;
        std::ranges::rotate(picture.fences, picture.fences.begin() + 1);
        picture.fences.back().put();
    }
    if (at_once) return true;
    for (Fence& fence : picture.fences)
        if (!fence.passed(seconds - watch.seconds())) return false;
    return !worked || watch.seconds() < seconds; // the shading is a part by itself
}

Result<DrawStatistics> Renderer::Impl::draw_all(const Frame& wanted, std::size_t upload_budget, double seconds) {
    const Stopwatch watch;
    DrawStatistics done;
    const auto taken = take_up(wanted, upload_budget, done);
    if (!taken) {
        unfinished_.reset();
        refinement_.reset();
        return tl::unexpected(taken.error());
    }
    const Frame& frame = *taken;
    // With what is under its pixels, or it is made anew for that.
    if (last_ && *last_ == frame && (cast_ || holds_last_)) {
        unfinished_.reset();
        return done;
    }
    refinement_.reset();
    refined_ = false;
    std::vector<Layer> layers(frame.states.size());
    std::ranges::transform(frame.states, layers.begin(), layer_of);
    while (!layers.empty() && layers.back() == Layer::kOpaque) layers.pop_back();

    bool geometry_there = false;
    if (unfinished_ && unfinished_->layers == layers && same_geometry(unfinished_->frame, frame)) {
        unfinished_->wanted = wanted;
        unfinished_->frame = frame;
        begin_state();
    } else {
        unfinished_.reset();
        const glm::ivec2 old_size = size_, old_inner = inner_;
        const float old_samples = view_.picture.z;
        // The picture turns, and nothing else about it changes: then the eye takes cones for the surface. Until the
        // view rests it stays with them.
        const bool hurries = frame.quality == Quality::kInteractive;
        const bool moves = hurries && last_ && wanted_mesh_ == wanted.mesh && last_->states == frame.states &&
                           (cast_ || last_->camera != frame.camera);
        const bool by_caster =
            frame.surface_awaited || (hurries && (moves || (cast_ && last_)) && drawn_ != nullptr && casts(frame));
        const bool reads_depths = frame.skeleton || !frame.lines.empty();
        if (auto resized = resize(frame.size, by_caster ? Quality::kFull : frame.quality,
                                  by_caster && !reads_depths ? Targets::kPicture : Targets::kAll);
            !resized) {
            last_.reset();
            return tl::unexpected(resized.error());
        }
        begin_state();
        geometry_there = last_ && holds_last_ && last_layers_ == layers && same_geometry(*last_, frame) &&
                         size_ == old_size && inner_ == old_inner && view_.picture.z == old_samples;
        if (by_caster) {
            done.cones = cast(frame, layers);
            done.geometry = true;
        } else if (!geometry_there) {
            moving_ = moves;
            wanted_mesh_ = wanted.mesh;
            unfinished_ = std::make_unique<Unfinished>();
            unfinished_->wanted = wanted, unfinished_->frame = frame, unfinished_->layers = layers;
            unfinished_->geometry = draw_geometry(unfinished_->frame, drawn_, unfinished_->layers);
            if (!last_ || old_size != size_) seconds = kUntilDone; // there is no picture meanwhile
        }
        cast_ = by_caster || (unfinished_ && cast_);
        holds_last_ = !by_caster && !unfinished_;
    }
    if (unfinished_) {
        if (!draw_parts(*unfinished_, seconds - watch.seconds())) {
            restore_state();
            unfinished_->seconds += watch.seconds();
            done.unfinished = true;
            return done;
        }
        const auto& triangles = unfinished_->geometry->result();
        if (!triangles) {
            const Error error = triangles.error();
            unfinished_.reset();
            last_.reset();
            return tl::unexpected(error);
        }
        done.triangles = *triangles;
        done.geometry = true;
        done.seconds = unfinished_->seconds;
        unfinished_.reset();
        cast_ = false;
        holds_last_ = true;
    }
    // Pointing elsewhere changes what few pixels show; a software rasteriser takes its time for all.
    const bool can_change_parts = !has_glass_ || gl_has_lists(); // layers are not kept
    const Extent extent =
        can_change_parts && geometry_there && differs_in_hover_only(*last_, frame) ? Extent::kChanged : Extent::kAll;
    if (auto shaded = cast_ ? Result<void>{} : shade(frame, drawn_, extent); !shaded) {
        last_.reset();
        return tl::unexpected(shaded.error());
    }
    lit_is_mean_ = lit_is_mean_ && extent == Extent::kChanged;
    note_gl_errors("shading");
    draw_overlays(frame, layers);
    note_gl_errors("the overlays");
    done.shaded = true;
    restore_state();
    last_ = frame;
    last_layers_ = std::move(layers);
    if (gl_ran_out_of_memory()) throw OutOfGraphicsMemory(0); // drivers may say it late
    done.seconds += watch.seconds();
    return done;
}

void Renderer::Impl::finish() {
    if (!unfinished_) return;
    const Frame wanted = unfinished_->wanted;
    (void)draw(wanted, 0, kUntilDone);
}

Image Renderer::Impl::read_image() const { return read_picture(picture_, size_); }

void Renderer::Impl::present(unsigned framebuffer, int x, int y) const {
    present_picture(picture_target_, size_, framebuffer, x, y);
}

} // namespace ramus::render
