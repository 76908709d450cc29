#include "app/commands/picture_stage.h"

#include "app/commands/inputs.h"
#include "app/commands/progress.h"
#include "app/picture/figures.h"
#include "app/picture/other_session.h"
#include "app/session/numbers.h"
#include "app/workspace/deviation_maker.h"

#include <utility>

namespace ramus::app {

Result<void> PictureStage::make_surface() {
    if (std::exchange(tree_, document_.tree()) != document_.tree()) {
        surface_ = {};
        compared_.clear();
    }
    if (!tree_) return {}; // context shapes without a tree: no surface to compute
    SurfaceRequest request = surface_request(document_.marks());
    request.options.threads = flags_.surface.threads; // depends on the machine, not on the session
    if (surface_.mesh && surface_.request == request) return {};
    const auto make = [&](Job& job) { return make_ready(*document_.tree(), request, job); };
    RAMUS_TRY(surface, with_progress("surface", make, kNothingWritten));
    surface_ = std::move(surface);
    say(flags_,
        counted(surface_.mesh->triangle_count(), "triangle", "triangles") + " in " + rounded(surface_.seconds) + " s");
    return {};
}

Result<render::Frame> PictureStage::frame() {
    if (auto made = make_surface(); !made) return tl::unexpected(made.error());
    if (auto read = complete_assets(); !read) return tl::unexpected(read.error());
    if (auto measured = measure_deviation(); !measured) return tl::unexpected(measured.error());
    if (auto measured = measure_sections(); !measured) return tl::unexpected(measured.error());
    return compose(document_.session(), assets, surface_.mesh, viewing_of(picture_size()));
}

Viewing PictureStage::viewing_of(glm::ivec2 size) {
    Viewing viewing = viewing_;
    viewing.size = size;
    viewing.planes = planes_.planes(document_.session(), assets);
    return viewing;
}

Result<void> PictureStage::complete_assets() {
    Job job;
    auto read = [&] {
        const CancelOnInterrupt cancel(job);
        return complete(assets, document_, job);
    }();
    if (job.cancelled()) return fail(kNothingWritten);
    return read;
}

Result<void> PictureStage::measure_deviation() {
    const Marks& marks = document_.marks();
    if (marks.colour_by != ColourBy::kDeviation || !tree_) return {};
    const DeviationOf of = deviation_of(document_.tree(), marks, marks.options);
    if (assets.deviation.fits(of, surface_.mesh)) return {};
    const auto measure = [&](Job& job) {
        return make_deviation(of, flags_.surface.threads, marks.options.memory_bytes, surface_.mesh, nullptr, job);
    };
    RAMUS_TRY(found, with_progress("deviation", measure, kNothingWritten));
    say(flags_, "deviation from " + noun_of(marks.deviation, marks.comparison) + ", mm: mean " +
                    digits(found.mean_mm, 4) + ", 95th percentile " + digits(found.percentile_95_mm, 4) + ", most " +
                    digits(found.most_mm, 4));
    assets.deviation = std::move(found);
    return {};
}

Result<void> PictureStage::measure_sections() {
    refresh(assets, document_);
    if (!assets.followed.path || !surface_.mesh) return {};
    if (assets.sections && assets.sections->fits(assets.followed, surface_.mesh)) return {};
    const auto measure = [&](Job& job) { return make_sections(assets.followed, surface_.mesh, job); };
    RAMUS_TRY(sections, with_progress("sections", measure, kNothingWritten));
    assets.sections = std::move(sections);
    return {};
}

Result<std::shared_ptr<const render::PagedMesh>> PictureStage::current_mesh() {
    if (auto made = make_surface(); !made) return tl::unexpected(made.error());
    return surface_.mesh;
}

Result<void> PictureStage::make_compared_surface(ComparedRequest request) {
    request.surface.options.threads = flags_.surface.threads;
    for (const ComparedSurface& one : compared_)
        if (one.request == request) return {};
    const auto make = [&](Job& job) { return make_compared(*document_.tree(), request, job); };
    RAMUS_TRY(made,
              with_progress(request.kind == Compared::kIsosurface ? "isosurface" : "surface", make, kNothingWritten));
    for (const std::string& note : made.notes) say(flags_, request.mask + ": " + note);
    say(flags_,
        title_of(request.kind, document_.marks().comparison) + ": " +
            counted(made.lines ? made.lines->triangles.size() : made.mesh->triangle_count(), "triangle", "triangles"));
    std::erase_if(compared_, [&](const ComparedSurface& one) { return one.request.same_place(request); });
    compared_.push_back(std::move(made));
    return {};
}

Result<render::Sheet> PictureStage::sheet(glm::ivec2 size) {
    if (auto made = make_surface(); !made) return tl::unexpected(made.error());
    if (auto read = complete_assets(); !read) return tl::unexpected(read.error());
    if (auto measured = measure_deviation(); !measured) return tl::unexpected(measured.error());
    if (auto measured = measure_sections(); !measured) return tl::unexpected(measured.error());
    const Marks& marks = document_.marks();
    ShownSurfaces surfaces;
    for (const ComparedRequest& request : tree_ ? compared_requests(marks) : std::vector<ComparedRequest>())
        if (auto made = make_compared_surface(request); !made) return tl::unexpected(made.error());
    for (const ComparedSurface& one : compared_) show(surfaces, one);
    surfaces.set_own(marks.options, surface_.mesh, nullptr);
    const Viewing viewing = viewing_of(size);
    render::Sheet sheet = compose_sheet(document_.session(), assets, surfaces, viewing);
    const std::vector<Viewport> viewports = viewports_of(document_.session(), size, viewing.pixel_ratio);
    for (std::size_t i = 0; i < viewports.size(); ++i)
        sheet.viewports[i].frame.preview = surfaces.preview_of(viewports[i].surface);
    return sheet;
}

Result<render::BranchPicture> PictureStage::branch_picture() {
    RAMUS_TRY(requested, frame());
    if (const auto drawn = renderer_->draw(requested); !drawn) return tl::unexpected(drawn.error());
    return renderer_->read_branches();
}

Result<void> PictureStage::write_picture(const std::filesystem::path& path) {
    RAMUS_TRY(requested, sheet());
    if (const auto drawn = sheet_renderer_->draw_with_scale(requested); !drawn) return tl::unexpected(drawn.error());
    if (const auto finer = sheet_renderer_->refine(requested); !finer) return tl::unexpected(finer.error());
    return render::write_png(sheet_renderer_->read_image(), path);
}

Result<void> PictureStage::write_figure(const FigureRequest& request, Job& job) {
    const CancelOnInterrupt cancel(job);
    const ProgressBar bar("pictures", job);
    const auto compose_sized = [this](glm::ivec2 size) { return sheet(size); };
    return app::write_figure(*sheet_renderer_, compose_sized, viewing_.size, request, job);
}

Result<render::Image> PictureStage::draw_picture(const Session& session, glm::ivec2 size,
                                                 const FigureOptions& options) {
    RAMUS_TRY(requested, frame());
    requested.camera = session.camera;
    if (session.marks != document_.marks()) {
        Job job;
        const CancelOnInterrupt cancel(job);
        Viewing viewing = viewing_;
        viewing.size = size;
        RAMUS_TRY(other, compose_as(session, document_, assets, surface_.mesh, viewing, job));
        requested = std::move(other);
    }
    requested.size = size;
    render::Sheet sheet = render::sheet_of(std::move(requested));
    app::dress(sheet, options);
    render::SheetRenderer alone(*renderer_); // keeps the state of the other viewports
    if (const auto drawn = alone.draw_with_scale(sheet); !drawn) return tl::unexpected(drawn.error());
    if (const auto finer = alone.refine(sheet); !finer) return tl::unexpected(finer.error());
    return alone.read_image();
}

} // namespace ramus::app
