#include "app/workspace/workspace.h"

#include "core/io/run_inputs.h"

#include <algorithm>

namespace ramus::app {

Workspace::Workspace(const std::function<void()>& wake)
    : context(wake), loader_(wake), surface_(wake), comparison_(wake), deviation_(wake), validation_(wake),
      lesions_(wake), contacts_(wake), centerlines_(wake), cones_(wake) {
    assets.centerlines_follow = true;
}

void Workspace::open(const std::filesystem::path& path) {
    io::note_input(path, io::InputKind::kSession); // until a tree is read from it
    asked_for_ = std::filesystem::absolute(path).lexically_normal();
    // What is shown without a tree waits for one; what is shown beside a tree belongs to that.
    Marks like = document.marks();
    if (document.tree()) like.context.clear();
    load_with(path, [path, like = std::move(like), how = reading](Job& job) { return load(path, like, how, job); });
}

void Workspace::recover(const autosave::Snapshot& snapshot) {
    const auto read = [snapshot, like = document.marks().options, how = reading](Job& job) {
        auto loaded = load(snapshot, how, job);
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
    marks_before_loading_ = document.marks();
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
        if (document.marks() != marks_before_loading_ && document.has_unsaved_work()) {
            arrival_ = std::move(arrived);
        } else {
            adopt(std::move(arrived->tree), arrived->path);
            first_is_coming_ = true;
        }
    }
    if (auto first = loader_.take_first_surface(); first && first_is_coming_) surface_.show(std::move(*first));
}

void Workspace::let_in() {
    if (auto arrived = std::exchange(arrival_, std::nullopt)) adopt(std::move(arrived->tree), arrived->path);
}

void Workspace::adopt(LoadedTree loaded, const std::filesystem::path& path) {
    lesions_.cancel(); // what is on its way belongs to the tree before
    context.forget();
    comparison_.forget();
    deviation_.forget();
    validation_.forget();
    centerlines_.forget();
    cones_.forget();
    keep_loaded(loaded.assets, std::exchange(assets, {}), loaded.session.marks);
    assets = std::move(loaded.assets);
    assets.centerlines_follow = true;
    tried_.reset();
    if (!loaded.maker && assets.tree) loaded.maker = std::make_shared<SurfaceMaker>(assets.tree);
    surface_.open(std::move(loaded.maker), std::move(loaded.cones));
    document.open(assets.tree, std::move(loaded.session), assets.facts, std::move(loaded.file), std::move(loaded.base));
    tree_shown_ = document.tree();
    if (loaded.unsaved_changes) document.mark_unsaved(*loaded.unsaved_changes);
    opened_ = Opened{path, loaded.has_camera, loaded.unsaved_changes.has_value()};
    changed_ = true;
}

bool Workspace::follow_tree() {
    if (!document.tree() || document.tree() == tree_shown_) return false;
    tree_shown_ = document.tree();
    first_is_coming_ = false; // of the tree before
    lesions_.cancel();
    comparison_.forget();
    deviation_.forget();
    tried_.reset();
    surface_.change_tree(tree_shown_, request());
    changed_ = true;
    return true;
}

// Centerlines of a large tree come later than its cones.
bool Workspace::between_trees() const {
    if (!document.tree() || tree_shown_ != document.tree()) return false;
    const bool no_lines = assets.tree == tree_shown_ && !assets.centerlines.lines;
    return surface_.between_trees() || (no_lines && centerlines_.worker().busy());
}

void Workspace::await_tree() {
    (void)follow_tree();
    surface_.await_tree();
    refresh(assets, document, request().options);
    complete_centerlines(assets, request().options);
    changed_ = true;
}

SurfaceRequest Workspace::request() const {
    SurfaceRequest request = surface_request(document.marks());
    if (tried_) request.options = *tried_;
    return request;
}

const Assets& Workspace::current_assets() {
    refresh(assets, document, tried_ ? *tried_ : document.marks().options);
    return assets;
}

void Workspace::follow_surface() {
    if (!document.tree()) return;
    // The first surface of a tree comes with it.
    if (first_is_coming_ && loader_.worker().busy()) return;
    first_is_coming_ = false;
    surface_.follow(request(), tried_.has_value());
}

void Workspace::await_preview() {
    surface_.await_preview();
    changed_ |= surface_.take_changed();
}

void Workspace::follow_lesions() {
    const Marks& now = document.marks();
    if (lesions_.busy() || !lesions_awaited(assets, now, GridIs::kMadeAhead) || lesions_failed_ == planned(now)) return;
    lesions_of_ = planned(now);
    lesions_.start("Measuring distances", [this, copy = assets, marks = now](Job&, const Worker::Post& post) mutable {
        complete_lesions(copy, marks, GridIs::kMadeAhead);
        post([this, copy] {
            merge(assets, copy);
            changed_ = true;
        });
    });
}

bool Workspace::contacts_due() const {
    const mesh::SurfaceOptions options = request().options;
    if (!document.tree() || tree_shown_ != document.tree()) return false;
    if (assets.tree == tree_shown_ && assets.contacts.fits(options)) return false;
    if (contacts_of_ == std::pair(tree_shown_, options)) return false;
    return contacts_wanted_ || document.marks().contact_marks || tree_shown_->points.size() <= kMostSoughtUnasked;
}

bool Workspace::seeking_contacts() const { return contacts_.busy() || contacts_due(); }

// What is found soon is let come; an edit or other options make it stale, and then it is looked for again.
void Workspace::follow_contacts() {
    if (contacts_.busy() || !contacts_due()) return;
    const bool wanted = contacts_wanted_ || document.marks().contact_marks;
    if (!wanted && (surface_.worker().busy() || loader_.worker().busy())) return;
    const mesh::SurfaceOptions options = request().options;
    contacts_of_ = {tree_shown_, options};
    contacts_.start("Looking for contacts", [this, tree = tree_shown_, options](Job&, const Worker::Post& post) {
        post([this, tree, found = app::contacts_of(*tree, options)] {
            contacts_of_ = {};
            if (document.tree() != tree) return;
            if (assets.tree != tree) refresh(assets, document, request().options);
            assets.contacts = found;
            changed_ = true;
        });
    });
}

void Workspace::follow_cones() {
    if (cones_wanted_ && assets.tree == document.tree()) changed_ |= cones_.update(assets, request().options);
}

// Of the surface that is shown, once it is more than provisional.
std::optional<DeviationWork> Workspace::missing_deviation() const {
    const Marks& marks = document.marks();
    if (!document.tree() || tree_shown_ != document.tree() || marks.colour_by != ColourBy::kDeviation || !shown().mesh)
        return {};
    const mesh::SurfaceOptions options = request().options;
    DeviationOf of = deviation_of(document.tree(), marks, options);
    const SurfaceDeviation& have = assets.deviation;
    if (!surface_.problem().empty()) return {}; // what is shown is no more than provisional
    if (have.of == of && !have.trouble.empty()) return {};
    if (have.fits(of, shown().mesh) && (have.preview == shown().preview || !shown().preview)) return {};
    return DeviationWork{std::move(of), options.threads, options.memory_bytes, shown().mesh, shown().preview};
}

void Workspace::follow_deviation() {
    deviation_.drain();
    if (auto news = deviation_.take_news()) {
        assets.deviation = std::move(*news);
        changed_ = true;
    }
    if (deviation_.failed()) { // once: nothing is missing then
        assets.deviation = {};
        assets.deviation.of = deviation_.failed()->of;
        assets.deviation.trouble = deviation_.problem();
        changed_ = true;
    }
    if (document.marks().colour_by != ColourBy::kDeviation) assets.deviation = {};
    const bool something_else_first =
        surface_.worker().busy() || loader_.worker().busy() || shown().provisional || surface_.awaited(request());
    deviation_.follow(missing_deviation(), something_else_first);
}

std::optional<ValidationOf> Workspace::missing_validation() const {
    if (!validation_wanted_ || !document.tree() || tree_shown_ != document.tree() || tried_) return {};
    ValidationOf of = validation_of(document.tree(), document.marks());
    if (assets.validation.fits(of)) return {};
    return of;
}

// After the surface that is shown, which it makes again with all branches.
void Workspace::follow_validation() {
    validation_.drain();
    if (auto news = validation_.take_news()) {
        assets.validation = std::move(*news);
        changed_ = true;
    }
    validation_.follow(missing_validation(), surface_.worker().busy() || loader_.worker().busy());
}

ShownSurfaces Workspace::surfaces() const {
    ShownSurfaces surfaces;
    for (const ComparedSurface& one : comparison_.surfaces()) show(surfaces, one);
    surfaces.set_own(document.marks().options, shown().mesh, shown().preview);
    return surfaces;
}

void Workspace::cancel_work() {
    if (loader_.worker().busy()) {
        loader_.cancel();
        if (std::exchange(first_is_coming_, false)) surface_.give_up(request(), "cancelled");
    } else if (surface_.worker().busy()) {
        surface_.give_up("cancelled");
    } else if (comparison_.worker().busy()) {
        comparison_.cancel();
    } else if (deviation_.worker().busy()) {
        deviation_.cancel();
    } else if (validation_.worker().busy()) {
        validation_.cancel();
    }
    context.cancel();
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
    const std::string lesions_failure = lesions_.take_failure();
    if (!lesions_failure.empty()) lesions_failed_ = lesions_of_;
    tell(lesions_failure, lesions_);
    tell(comparison_.take_failure(), comparison_.worker());
    tell(deviation_.take_failure(), deviation_.worker());
    tell(contacts_.take_failure(), contacts_);
    tell(centerlines_.take_failure(), centerlines_.worker());
    tell(cones_.take_failure(), cones_.worker());
    tell(validation_.take_failure(), validation_.worker());
}

bool Workspace::update() {
    const bool was_busy = busy();
    take_loaded();
    (void)follow_tree();
    surface_.drain();
    lesions_.drain();
    comparison_.drain();
    contacts_.drain();
    take_failures();
    if (context.update(document.marks().context, assets)) changed_ = true;
    if (!document.tree()) document.set_claims(assets.claims_of(document.marks().context));
    while (const auto error = context.take_error()) errors_.push_back(*error);
    follow_lesions();
    if (!surface_.take_just_shown()) follow_surface();
    follow_contacts();
    if (assets.tree == document.tree()) changed_ |= centerlines_.update(assets, request().options);
    follow_cones();
    follow_deviation();
    follow_validation();
    if (document.tree())
        comparison_.follow(document.tree(), document.marks(), surface_.worker().busy() || loader_.worker().busy());
    changed_ |= surface_.take_changed();
    changed_ |= comparison_.take_changed();
    return std::exchange(changed_, false) || was_busy != busy();
}

bool Workspace::busy() const { return std::ranges::any_of(workers(), &Worker::busy) || context.busy(); }

std::string Workspace::activity() const {
    constexpr const char* kComputing = "Computing the surface";
    const bool loading = loader_.worker().busy(), meshing = surface_.worker().busy();
    if (loading && !first_is_coming_) return loader_.worker().title();
    if (!meshing && lesions_.busy()) return lesions_.title();
    if (!meshing && context.busy()) return context.title();
    if (!meshing && !loading && comparison_.worker().busy()) return comparison_.worker().title();
    if (!meshing && !loading && deviation_.worker().busy()) return deviation_.worker().title();
    if (!meshing && !loading && validation_.worker().busy()) return validation_.worker().title();
    return busy() ? kComputing : std::string{};
}

float Workspace::progress() const {
    for (const Worker* worker : workers())
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
