#include "app/workspace/workspace.h"

#include "app/session/reading_options.h"
#include "core/io/run_inputs.h"

#include <algorithm>

namespace ramus::app {

namespace {

std::filesystem::path absolute_path(const std::filesystem::path& path) {
    return path.empty() ? path : std::filesystem::absolute(path).lexically_normal();
}

} // namespace

Workspace::Workspace(const std::function<void()>& wake)
    : loader_(wake), surface_(wake), works_(background_works(wake, compared_)) {
    assets_.centerlines_follow = true;
}

void Workspace::say_reading(io::ReadOptions reading, const std::filesystem::path& file) {
    said_reading_ = std::move(reading);
    said_of_ = absolute_path(file);
}

io::ReadOptions Workspace::reading_of(const std::filesystem::path& file) const {
    return said_of_.empty() || said_of_ == absolute_path(file) ? said_reading_ : io::ReadOptions();
}

void Workspace::open(const std::filesystem::path& path, const io::ReadOptions& how) {
    io::note_input(path, io::InputKind::kSession); // until its tree is read
    asked_for_ = absolute_path(path);
    // Context and scans that are shown without a tree are kept for the next tree; those next to a tree belong to that
    // tree.
    Marks like = document_.marks();
    if (document_.tree()) like.context.clear(), like.scans.clear();
    load_with(path, [path, like = std::move(like), reading = over(how, reading_of(path))](Job& job) {
        return load(path, like, reading, job);
    });
}

void Workspace::recover(const autosave::Snapshot& snapshot) {
    const auto read = [snapshot, like = document_.marks().options](Job& job) {
        auto loaded = load(snapshot, job);
        if (!loaded) return loaded;
        loaded->session.marks.options.threads = like.threads;
        loaded->session.marks.options.memory_bytes = like.memory_bytes;
        return loaded;
    };
    load_with(snapshot.file.empty() ? subject_of(snapshot.session) : snapshot.file, read);
}

void Workspace::load_with(const std::filesystem::path& path, TreeLoader::Read read) {
    first_is_coming_ = false;
    arrival_.reset();
    marks_before_loading_ = document_.marks();
    loader_.start(path, std::move(read));
    changed_ = true;
}

void Workspace::take_loaded() {
    loader_.update();
    if (auto error = loader_.take_error()) {
        errors_.push_back(std::move(*error));
        changed_ = true;
    }
    if (auto arrived = loader_.take_arrival()) {
        changed_ = true;
        if (document_.marks() != marks_before_loading_ && document_.has_unsaved_work()) {
            arrival_ = std::move(arrived);
        } else {
            adopt(std::move(arrived->tree), arrived->path);
            first_is_coming_ = true;
        }
    }
    if (auto first = loader_.take_first_surface(); first && first_is_coming_) surface_.show(std::move(*first));
}

void Workspace::accept_arrival() {
    if (auto arrived = std::exchange(arrival_, std::nullopt)) adopt(std::move(arrived->tree), arrived->path);
}

void Workspace::adopt(LoadedTree loaded, const std::filesystem::path& path) {
    for (const auto& work : works_) work->forget();
    compared_.clear();
    keep_loaded(loaded.assets, std::exchange(assets_, {}), loaded.session.marks);
    assets_ = std::move(loaded.assets);
    assets_.centerlines_follow = true;
    tried_.reset();
    if (!loaded.maker && assets_.tree) loaded.maker = std::make_shared<SurfaceMaker>(assets_.tree);
    surface_.open(std::move(loaded.maker), std::move(loaded.cones));
    document_.open(assets_.tree, std::move(loaded.session), assets_.facts, std::move(loaded.file),
                   std::move(loaded.base));
    tree_shown_ = document_.tree();
    if (loaded.unsaved_changes) document_.mark_unsaved(*loaded.unsaved_changes);
    opened_ = Opened{path, loaded.has_camera, loaded.unsaved_changes.has_value()};
    changed_ = true;
}

bool Workspace::follow_tree() {
    if (!document_.tree() || document_.tree() == tree_shown_) return false;
    tree_shown_ = document_.tree();
    first_is_coming_ = false; // of the tree before
    compared_.clear();        // of the tree before
    tried_.reset();
    surface_.change_tree(tree_shown_, request());
    changed_ = true;
    return true;
}

// Centerlines of a large tree are ready later than its cones.
bool Workspace::between_trees() const {
    if (!document_.tree() || tree_shown_ != document_.tree()) return false;
    const bool no_lines = assets_.tree == tree_shown_ && !assets_.centerlines.lines;
    return surface_.between_trees() || (no_lines && work(WorkKind::kCenterlines).worker().busy());
}

void Workspace::await_tree() {
    (void)follow_tree();
    surface_.await_tree();
    refresh(assets_, document_, request().options);
    complete_centerlines(assets_, request().options);
    changed_ = true;
}

SurfaceRequest Workspace::request() const {
    SurfaceRequest request = surface_request(document_.marks());
    if (tried_) request.options = *tried_;
    return request;
}

const Assets& Workspace::current_assets() {
    refresh(assets_, document_, tried_ ? *tried_ : document_.marks().options);
    return assets_;
}

void Workspace::follow_surface() {
    if (!document_.tree()) return;
    // The loader makes the first surface of a tree.
    if (first_is_coming_ && loader_.worker().busy()) return;
    first_is_coming_ = false;
    surface_.follow(request(), tried_.has_value());
}

void Workspace::await_preview() {
    surface_.await_preview();
    changed_ |= surface_.take_changed();
}

WorkView Workspace::view() const {
    const SurfaceRequest request = this->request();
    return {.document = document_,
            .request = request,
            .shown = shown(),
            .of_this_tree = document_.tree() && tree_shown_ == document_.tree() && assets_.tree == tree_shown_,
            .surface_busy = surface_.worker().busy() || loader_.worker().busy(),
            .surface_final = !shown().provisional && !surface_.awaited(request),
            .surface_failed = !surface_.problem().empty(),
            .tried = tried_.has_value(),
            .contacts_wanted = contacts_wanted_,
            .validation_wanted = validation_wanted_,
            .cones_wanted = cones_wanted_};
}

ShownSurfaces Workspace::surfaces() const {
    ShownSurfaces surfaces;
    for (const ComparedSurface& one : compared_) show(surfaces, one);
    surfaces.set_own(document_.marks().options, shown().mesh, shown().preview);
    return surfaces;
}

void Workspace::cancel_work() {
    if (loader_.worker().busy()) {
        loader_.cancel();
        if (std::exchange(first_is_coming_, false)) surface_.give_up(request(), "cancelled");
    } else if (surface_.worker().busy()) {
        surface_.give_up("cancelled");
    } else {
        for (const auto& work : works_)
            if (!work->quiet()) work->cancel(assets_);
    }
    changed_ = true;
}

void Workspace::retry(WorkKind kind) {
    if (kind == WorkKind::kContext)
        std::erase_if(assets_.context_shapes, [](const auto& one) {
            return !one.second.value && one.second.value.error().what == "cancelled";
        });
    works_[static_cast<std::size_t>(kind)]->retry();
    changed_ = true;
}

void Workspace::retry_surface() {
    surface_.retry();
    changed_ = true;
}

void Workspace::take_failures() {
    const auto tell = [&](const std::string& failure, const Worker& worker) {
        if (failure.empty()) return;
        errors_.push_back({"the work was given up: " + failure, worker.title(),
                           failure == "std::bad_alloc" ? "there is not enough memory for it" : ""});
        changed_ = true;
    };
    tell(loader_.take_failure(), loader_.worker());
    tell(surface_.take_failure(), surface_.worker());
}

bool Workspace::update() {
    const bool was_busy = busy();
    take_loaded();
    (void)follow_tree();
    surface_.drain();
    take_failures();
    if (assets_.tree != document_.tree()) refresh(assets_, document_, request().options);
    if (!surface_.take_just_shown()) follow_surface();
    const WorkView now = view();
    for (const auto& work : works_) changed_ |= work->follow(now, assets_, errors_);
    if (!document_.tree()) document_.set_claims(assets_.claims_of(document_.marks()));
    changed_ |= surface_.take_changed();
    return std::exchange(changed_, false) || was_busy != busy();
}

const BackgroundWork* Workspace::busy_work() const {
    const auto work =
        std::ranges::find_if(works_, [](const auto& one) { return !one->quiet() && one->worker().busy(); });
    return work == works_.end() ? nullptr : work->get();
}

bool Workspace::busy() const { return std::ranges::any_of(surface_workers(), &Worker::busy) || busy_work() != nullptr; }

std::string Workspace::activity() const {
    if (loader_.worker().busy() && !first_is_coming_) return loader_.worker().title();
    if (std::ranges::any_of(surface_workers(), &Worker::busy)) return "Computing the surface";
    const BackgroundWork* work = busy_work();
    return work == nullptr ? std::string() : work->worker().title();
}

float Workspace::progress() const {
    for (const Worker* worker : surface_workers())
        if (worker->busy()) return worker->progress();
    const BackgroundWork* work = busy_work();
    return work == nullptr ? 1.0F : work->worker().progress();
}

std::optional<Error> Workspace::take_error() {
    if (errors_.empty()) return {};
    Error error = std::move(errors_.front());
    errors_.pop_front();
    return error;
}

} // namespace ramus::app
