#include "render/renderer/passes/cast_pass.h"

#include "core/base/stopwatch.h"
#include "render/renderer/passes/gl_state.h"
#include "render/scene/look_data.h"
#include "render/scene/record_flags.h"
#include "render/scene/seen_plane.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <utility>

namespace ramus::render {

namespace {

constexpr int kCastTaps = 20; // of the occlusion, as at rest

void find_bodies(const Frame& frame, const GpuShapes& shapes, std::vector<caster::Body>& bodies,
                 std::vector<std::shared_ptr<const ShapeTriangles>>& made_of) {
    const float point = frame.pixel_ratio;
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = shapes.of(frame.context[i], true);
        if (shape == nullptr) continue;
        made_of.push_back(shape->made_of());
        bodies.push_back({made_of.back().get(), record::kSolid | record::kContext | number_of(i),
                          frame.context[i].clear(), shape->lines() ? 0.5F * kContextLineWidth * point : 0.0F});
    }
    std::size_t index = frame.lesions.spheres.size();
    for (const auto& lesion : frame.lesions.meshes) {
        const bool drawn = frame.lesions.look(index).opacity > 0.0F;
        const std::uint32_t number = number_of(index++);
        const Shape* shape = shapes.of(lesion);
        if (shape == nullptr || !drawn) continue;
        made_of.push_back(shape->made_of());
        bodies.push_back({made_of.back().get(), record::kSolid | number, true, 0.0F});
    }
}

caster::View view_of(const Frame& frame, const ViewSetup& from) {
    constexpr int kAcross = caster::kTile * caster::kOccludedTiles;
    const glm::vec4& pixel = from.block.pixel_to_eye;
    return {.width = from.picture.x,
            .height = from.picture.y,
            .stride = (from.picture.x + kAcross - 1) / kAcross * kAcross,
            .centre_x = pixel.x,
            .centre_y = pixel.y,
            .mm_a_pixel = pixel.z,
            .flat = frame.camera.orthographic,
            .block = from.block,
            .taps = frame.appearance.occlusion > 0.0F ? kCastTaps : 0,
            .shadows = frame.appearance.shadows > 0.0F};
}

} // namespace

// All inputs, so that later changes do not affect it.
struct CastPass::Work {
    Made made;
    bool outlined = false, done = false;
    glm::dmat4 eye{1.0}, surface_to_clip{1.0};
    LookData data;
    caster::Uniforms uniforms{};
    PlanesBlock planes{};
    std::vector<BranchRecord> records;
    std::vector<caster::Body> bodies;
    std::vector<std::shared_ptr<const ShapeTriangles>> shapes; // keeps the bodies' shapes alive
    std::shared_ptr<const PagedMesh> surface;
    Stopwatch watch;
};

std::shared_ptr<CastPass::Work> CastPass::prepare(const Subject& subject, const ViewSetup& view,
                                                  BranchRecords& records) {
    auto work = std::make_shared<Work>();
    work->made.frame = subject.frame;
    work->made.layers = subject.layers;
    work->made.view = view;
    const Frame& frame = work->made.frame;
    work->eye = eye_matrix(frame.camera);
    work->outlined = records.send(subject, false).any_selected;
    const bool glass = std::ranges::find(subject.layers, Layer::kGlass) != subject.layers.end();
    work->data = look_data_of(frame, frame.centerlines.get(), work->eye);
    work->uniforms = {view.block, look_of(frame, view, glass, work->outlined), work->data.block};
    work->planes = planes_block(frame.planes, work->eye, view.block, view.pixels_a_point(frame));
    work->records = records.records();
    find_bodies(frame, subject.scene.shapes(), work->bodies, work->shapes);
    work->surface = subject.scene.whole_surface();
    if (work->surface) work->surface_to_clip = view.clip_from(work->surface->origin());
    return work;
}

void CastPass::make(Work& work, caster::Caster& caster, const std::shared_ptr<const caster::FittedCones>& known) {
    const Frame& frame = work.made.frame;
    caster.follow(frame, known);
    work.made.cones = caster.draw(frame, view_of(frame, work.made.view), work.eye,
                                  {work.uniforms, work.outlined, work.made.layers, work.records, work.data, work.bodies,
                                   work.surface.get(), work.surface_to_clip, work.planes});
    work.made.seconds = work.watch.seconds();
}

std::uint64_t CastPass::draw(const Subject& subject, const ViewSetup& view, BranchRecords& records) {
    work_.reset();
    worker_.reset(); // waits for the running work; then the other caster is free
    const auto work = prepare(subject, view, records);
    make(*work, other(), caster().fitted());
    shown_ = 1 - shown_;
    return work->made.cones;
}

void CastPass::begin(const Subject& subject, const ViewSetup& view, BranchRecords& records) {
    if (!worker_) worker_ = std::make_unique<Worker>([] {});
    work_ = prepare(subject, view, records);
    worker_->start("Casting",
                   [work = work_, &with = other(), known = caster().fitted()](Job&, const Worker::Post& post) {
                       make(*work, with, known);
                       post([work] { work->done = true; });
                   });
}

std::optional<CastPass::Made> CastPass::take(double seconds) {
    if (!work_) return {};
    constexpr double kLong = 1e4; // seconds
    const Stopwatch watch;
    do { // the next notification may belong to earlier work
        const double left = std::clamp(seconds - watch.seconds(), 0.0, kLong);
        worker_->wait(std::chrono::milliseconds(std::lround(1e3 * left)));
        worker_->drain();
        if (!worker_->take_failure().empty()) {
            work_.reset();
            throw std::bad_alloc();
        }
    } while (!work_->done && watch.seconds() < seconds);
    if (!work_->done) return {};
    Made made = std::move(work_->made);
    work_.reset();
    shown_ = 1 - shown_;
    return made;
}

void CastPass::forget() {
    if (!work_) return;
    worker_->cancel();
    work_.reset();
}

void CastPass::send_picture(const PictureTarget& to) const {
    glTextureSubImage2D(to.colour, 0, 0, 0, to.size.x, to.size.y, GL_RGBA, GL_UNSIGNED_BYTE, caster().rgba());
}

void CastPass::send_depths(const PictureTarget& picture, const ResolvedTarget& to) const {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, caster().stride());
    glTextureSubImage2D(to.opaque_depth, 0, 0, 0, picture.size.x, picture.size.y, GL_RED, GL_FLOAT, caster().depths());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void CastPass::send_ids(const PictureTarget& picture) {
    if (ids_size_ != picture.size) {
        ids_size_ = glm::ivec2(0); // until it is there
        ids_texture_ = make_texture(GL_R32UI, picture.size.x, picture.size.y);
        ids_size_ = picture.size;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, caster().stride());
    glTextureSubImage2D(ids_texture_, 0, 0, 0, picture.size.x, picture.size.y, GL_RED_INTEGER, GL_UNSIGNED_INT,
                        caster().ids());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

} // namespace ramus::render
