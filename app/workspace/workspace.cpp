#include "app/workspace/workspace.h"

#include <chrono>
#include <oneapi/tbb/task_arena.h>

namespace ramus::app {

namespace {

constexpr const char* kComputing = "Computing the surface";

// While the window comes up, and draws the cones, one core is free.
Result<ReadySurface> first_surface(SurfaceMaker& maker, const SurfaceRequest& request, std::size_t segments, Job& job) {
    constexpr std::size_t kMany = 100'000; // there the surface is what takes time, and wants all cores
    if (segments > kMany) return maker.next(request, job);
    tbb::task_arena one(1);
    return one.execute([&] { return maker.next(request, job); });
}

} // namespace

Workspace::Workspace(std::function<void()> wake)
    : context(wake), loader_(wake), mesher_(wake), planner_(wake), comparer_(wake) {}

void Workspace::open(const std::filesystem::path& path) {
    load_with(path, [path, like = document.marks(), how = reading](Job& job) { return load(path, like, how, job); });
}

void Workspace::recover(const autosave::Snapshot& snapshot) {
    load_with(snapshot.file.empty() ? snapshot.session.tree.path : snapshot.file,
              [snapshot, like = document.marks().options, how = reading](Job& job) {
                  auto loaded = load(snapshot, how, job);
                  if (loaded) {
                      loaded->session.marks.options.threads = like.threads;
                      loaded->session.marks.options.memory_bytes = like.memory_bytes;
                  }
                  return loaded;
              });
}

void Workspace::load_with(const std::filesystem::path& path, std::function<Result<LoadedTree>(Job&)> load) {
    first_is_coming_ = false;
    arrival_.reset();
    loader_.start("Reading " + path.filename().string(),
                  [this, path, load = std::move(load), before = document.marks()](Job& job, const Worker::Post& post) {
                      auto loaded = load(job);
                      if (job.cancelled()) return;
                      if (!loaded) {
                          post([this, error = loaded.error()] {
                              errors_.push_back(error);
                              changed_ = true;
                          });
                          return;
                      }
                      const SurfaceRequest request = surface_request(loaded->session.marks);
                      const auto maker = loaded->maker;
                      const std::size_t segments = loaded->assets.tree->segment_count();
                      // std::function wants something to copy.
                      const auto shared = std::make_shared<LoadedTree>(std::move(*loaded));
                      post([this, path, shared, before] {
                          changed_ = true;
                          if (document.marks() != before && document.has_unsaved_work()) {
                              arrival_ = shared;
                              arrival_path_ = path;
                              return;
                          }
                          adopt(std::move(*shared), path);
                          first_is_coming_ = true;
                      });
                      auto first = first_surface(*maker, request, segments, job);
                      if (first && !job.cancelled())
                          post([this, first] {
                              if (first_is_coming_) take(*first);
                          });
                  });
    changed_ = true;
}

void Workspace::let_in() {
    if (const auto arrived = std::exchange(arrival_, nullptr)) adopt(std::move(*arrived), arrival_path_);
}

void Workspace::adopt(LoadedTree loaded, const std::filesystem::path& path) {
    mesher_.cancel();
    comparer_.cancel();
    compared_.clear();
    comparing_.reset();
    failed_.reset();
    comparison_problem_.clear();
    planner_.cancel(); // lesions that are on their way belong to the tree before
    context.forget();
    keep_loaded(loaded.assets, std::exchange(assets, {}), loaded.session.marks);
    assets = std::move(loaded.assets);
    wanted_.reset();
    tried_.reset();
    problem_.clear();
    kept_.clear();
    maker_ = loaded.maker ? std::move(loaded.maker) : std::make_shared<SurfaceMaker>(assets.tree);
    document.open(assets.tree, std::move(loaded.session), assets.facts, std::move(loaded.file));
    if (loaded.unsaved_changes) document.mark_unsaved(*loaded.unsaved_changes);
    shown_ = std::move(loaded.cones);
    opened_ = Opened{path, loaded.has_camera, loaded.unsaved_changes.has_value()};
    just_shown_ = true;
    changed_ = true;
}

void Workspace::take(ReadySurface surface) {
    shown_ = std::move(surface);
    changed_ = true;
    just_shown_ = shown_.provisional;
    awaited_ = false;
    if (shown_.provisional) return;
    std::erase_if(kept_, [&](const ReadySurface& kept) { return kept.request == shown_.request; });
    kept_.push_front(shown_);
    if (kept_.size() > kKeptSurfaces) kept_.pop_back();
}

SurfaceRequest Workspace::request() const {
    SurfaceRequest request = surface_request(document.marks());
    if (tried_) request.options = *tried_;
    return request;
}

void Workspace::start_surface() {
    if (!document.tree()) return;
    // The first surface of a tree comes with it.
    if (first_is_coming_ && loader_.busy()) return;
    first_is_coming_ = false;
    SurfaceRequest request = this->request();
    if (wanted_ == request) {
        // What is only being tried is about to change: its preview is enough.
        const bool refine = shown_.provisional && shown_.request == request && !tried_;
        if (refine && !mesher_.busy() && problem_.empty()) {
            refining_ = true;
            make_next(request);
        }
        return;
    }
    if (mesher_.busy() && worth_finishing(request)) return;
    const bool small_change = wanted_ && wanted_->options == request.options && shown_.mesh && !shown_.provisional;
    refining_ = false;
    wanted_ = request;
    problem_.clear();
    mesher_.cancel();
    changed_ = true;
    if (shown_.mesh && !shown_.provisional && shown_.request == request) return;
    for (const ReadySurface& surface : kept_) {
        if (surface.request != request) continue;
        shown_ = surface;
        return;
    }
    make_next(request);
    if (!small_change) return;
    mesher_.wait(kPatience);
    mesher_.drain();
}

void Workspace::await_preview() {
    if (!shown_.preview_follows || !mesher_.busy() || std::exchange(awaited_, true)) return;
    mesher_.wait(kPreviewPatience);
    mesher_.drain();
}

// When only other branches are hidden, what is being made is the way to what is wanted now. And while somebody drags a
// slider, previews that never get finished would show nothing.
bool Workspace::worth_finishing(const SurfaceRequest& request) const {
    if (wanted_ && wanted_->options == request.options) return true;
    return !refining_ && std::chrono::steady_clock::now() - started_ < kShort;
}

void Workspace::make_next(const SurfaceRequest& request) {
    started_ = std::chrono::steady_clock::now();
    mesher_.start(kComputing, [this, request, maker = maker_](Job& job, const Worker::Post& post) {
        for (bool more = true; more;) {
            const auto made = maker->next(request, job);
            if (job.cancelled()) return;
            more = made && made->preview_follows;
            post([this, made] {
                if (made)
                    take(*made);
                else
                    problem_ = made.error().message();
                changed_ = true;
            });
        }
    });
}

const Assets& Workspace::current_assets() {
    refresh(assets, document, tried_ ? *tried_ : document.marks().options);
    return assets;
}

void Workspace::start_plan() {
    if (planner_.busy() || !lesions_awaited(assets, document.marks(), GridIs::kMadeAhead)) return;
    planner_.start("Measuring distances",
                   [this, copy = assets, marks = document.marks()](Job&, const Worker::Post& post) mutable {
                       complete_lesions(copy, marks, GridIs::kMadeAhead);
                       post([this, copy] {
                           merge(assets, copy);
                           changed_ = true;
                       });
                   });
}

ShownSurfaces Workspace::surfaces() const {
    ShownSurfaces surfaces;
    for (const ComparedSurface& one : compared_) show(surfaces, one);
    surfaces.set(document.marks().options.method, shown_.mesh, shown_.preview);
    return surfaces;
}

// The first that is in the picture and not as it shall be.
std::optional<ComparedRequest> Workspace::missing_surface() const {
    if (!document.tree()) return {};
    for (ComparedRequest& wanted : compared_requests(document.marks())) {
        const bool there = std::ranges::any_of(compared_, [&](const auto& one) { return one.request == wanted; });
        if (!there && failed_ != wanted) return std::move(wanted);
    }
    return {};
}

bool Workspace::comparing() const { return comparer_.busy() || missing_surface(); }

void Workspace::start_comparison() {
    const auto wanted = missing_surface();
    if (!wanted) {
        if (comparer_.busy()) comparer_.cancel(); // nobody wants it any more
        comparing_.reset();
        if (compared_surfaces(document.marks().comparison).empty()) compared_.clear();
        const auto wanted_now = compared_requests(document.marks());
        if (!failed_ || std::ranges::find(wanted_now, *failed_) == wanted_now.end())
            failed_.reset(), comparison_problem_.clear();
        return;
    }
    // The session's own surface comes first: both want the whole machine.
    if (mesher_.busy() || loader_.busy() || (comparer_.busy() && comparing_ == wanted)) return;
    comparing_ = wanted;
    changed_ = true;
    comparer_.start("Computing the " + std::string(mesh::row_of(wanted->kind).noun),
                    [this, request = *wanted, tree = document.tree()](Job& job, const Worker::Post& post) {
                        const auto made = make_compared(*tree, request, job);
                        if (job.cancelled()) return;
                        post([this, made, request] {
                            changed_ = true;
                            comparing_.reset();
                            if (!made) {
                                failed_ = request;
                                comparison_problem_ = made.error().message();
                                return;
                            }
                            if (failed_ && failed_->same_place(request)) failed_.reset(), comparison_problem_.clear();
                            std::erase_if(compared_, [&](const auto& one) { return one.request.same_place(request); });
                            compared_.push_back(*made);
                        });
                    });
}

void Workspace::cancel_work() {
    if (loader_.busy()) {
        loader_.cancel();
        if (std::exchange(first_is_coming_, false)) {
            wanted_ = request();
            problem_ = "cancelled";
        }
    } else if (mesher_.busy()) {
        mesher_.cancel();
        problem_ = "cancelled";
    } else if (comparer_.busy()) {
        comparer_.cancel();
        failed_ = std::exchange(comparing_, std::nullopt);
        comparison_problem_ = "cancelled";
    }
    context.cancel();
    changed_ = true;
}

void Workspace::retry_surface() {
    wanted_.reset();
    changed_ = true;
}

bool Workspace::update() {
    const bool was_busy = busy();
    loader_.drain();
    mesher_.drain();
    planner_.drain();
    comparer_.drain();
    for (Worker* worker : {&loader_, &mesher_, &planner_, &comparer_})
        if (const std::string failure = worker->take_failure(); !failure.empty()) {
            errors_.push_back({"the work was given up: " + failure, worker->title(),
                               failure == "std::bad_alloc" ? "there is not enough memory for it" : ""});
            if (worker == &mesher_) problem_ = errors_.back().what;
            if (worker == &comparer_) {
                failed_ = std::exchange(comparing_, std::nullopt);
                comparison_problem_ = errors_.back().what;
            }
            changed_ = true;
        }
    if (document.tree() && context.update(document.marks().context, assets)) changed_ = true;
    while (const auto error = context.take_error()) errors_.push_back(*error);
    start_plan();
    // A picture is drawn before a better one is begun: both want the whole machine.
    if (!std::exchange(just_shown_, false)) start_surface();
    start_comparison();
    return std::exchange(changed_, false) || was_busy != busy();
}

std::string Workspace::activity() const {
    if (loader_.busy() && !first_is_coming_) return loader_.title();
    if (!mesher_.busy() && planner_.busy()) return planner_.title();
    if (!mesher_.busy() && context.busy()) return context.title();
    if (!mesher_.busy() && !loader_.busy() && comparer_.busy()) return comparer_.title();
    return busy() ? kComputing : std::string{};
}

float Workspace::progress() const {
    for (const Worker* worker : {&loader_, &mesher_, &planner_, &comparer_})
        if (worker->busy()) return worker->progress();
    return context.progress();
}

std::optional<Error> Workspace::take_error() {
    if (errors_.empty()) return {};
    Error error = std::move(errors_.front());
    errors_.pop_front();
    return error;
}

} // namespace ramus::app
