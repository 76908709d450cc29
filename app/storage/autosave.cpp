#include "app/storage/autosave.h"

#include "app/session/document.h"
#include "app/session/json_text.h"
#include "app/storage/user_folders.h"
#include "core/io/json_text.h"
#include "core/io/output_file.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ramus::app {

namespace fs = std::filesystem;
using nlohmann::json;

namespace autosave {

namespace {

constexpr int kVersion = 1;
constexpr const char* kEnding = ".json";

// Whether the file at this path is still the one behind the descriptor, and was not deleted in between.
bool still_there(const fs::path& path, int descriptor) {
    struct stat by_name {
    }, by_descriptor{};
    return ::stat(path.c_str(), &by_name) == 0 && ::fstat(descriptor, &by_descriptor) == 0 &&
           by_name.st_ino == by_descriptor.st_ino && by_name.st_dev == by_descriptor.st_dev;
}

enum class Lock { kOurs, kTheirs, kUnknown };

Lock try_lock(int descriptor) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Lock::kOurs;
    return errno == EWOULDBLOCK ? Lock::kTheirs : Lock::kUnknown;
}

std::int64_t seconds_of(std::chrono::system_clock::time_point time) {
    return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

// Null: there is none.
json json_in(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    auto parsed = io::parsed_json(text, file.string());
    return parsed ? std::move(*parsed) : json();
}

// 0: it does not say.
pid_t process_of(const fs::path& file) {
    const json value = json_in(file);
    return value.is_object() && value.contains("process") && value["process"].is_number_integer()
               ? value["process"].get<pid_t>()
               : 0;
}

// Deletes what io::OutputFile left when its process was killed while writing: ".ramus-PID-N.part".
void clear_unfinished(const fs::path& path) {
    constexpr std::string_view kStart = ".ramus-";
    const std::string name = path.filename().string();
    if (!name.starts_with(kStart) || path.extension() != ".part") return;
    const pid_t process = std::atoi(name.c_str() + kStart.size());
    std::error_code ignored;
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) fs::remove(path, ignored);
}

bool is_alive(pid_t process) { return process > 0 && (::kill(process, 0) == 0 || errno == EPERM); }

} // namespace

Result<Slot> Slot::take(const fs::path& folder) {
    if (folder.empty()) return fail("there is no folder for it", {}, "set XDG_STATE_HOME or HOME");
    std::error_code error = user_folders::make_private(folder);
    if (error) return fail("the folder cannot be made: " + error.message(), folder.string(), "set XDG_STATE_HOME");
    constexpr int kAttempts = 1000;
    for (int i = 0; i < kAttempts; ++i) {
        Slot slot(folder / (std::to_string(::getpid()) + "-" + std::to_string(i) + kEnding), -1);
        // Skips names in use, which may have a file.
        if (fs::exists(slot.file_, error)) continue;
        slot.lock_ = ::open(slot.lock_file().c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        if (slot.lock_ < 0 && errno == EEXIST) continue;
        if (slot.lock_ < 0)
            return fail(std::string("nothing can be written there: ") + std::strerror(errno), folder.string(),
                        "check its permissions");
        if (try_lock(slot.lock_) != Lock::kTheirs && still_there(slot.lock_file(), slot.lock_)) return slot;
    }
    return fail("too many files of other runs lie there", folder.string(), "remove them");
}

Slot::Slot(Slot&& other) noexcept
    : file_(std::exchange(other.file_, fs::path())), lock_(std::exchange(other.lock_, -1)) {}

Slot& Slot::operator=(Slot&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(lock_, other.lock_);
    return *this;
}

Slot::~Slot() {
    if (lock_ >= 0) ::close(lock_);
}

fs::path Slot::lock_file() const { return fs::path(file_).replace_extension(".lock"); }

Result<void> Slot::write(const Snapshot& snapshot) const {
    const json value{
        {"ramus_autosave", kVersion},          {"process", ::getpid()},
        {"saved", seconds_of(snapshot.saved)}, {"changes", snapshot.changes},
        {"file", snapshot.file.string()},      {"session", to_json(snapshot.session, file_.parent_path())}};
    const auto text = json_text(value, file_.string());
    return text ? io::write_file(file_, *text) : tl::unexpected(text.error());
}

Result<Snapshot> Slot::read() const {
    const auto broken = fail("this recovery file is damaged", file_.string(), "discard it");
    const json value = json_in(file_);
    const auto number = [&](const char* name) {
        return value.contains(name) && value[name].is_number_integer() && value[name].get<std::int64_t>() >= 0;
    };
    if (!value.is_object() || !number("ramus_autosave") || !number("saved") || !number("changes") ||
        !value.contains("file") || !value["file"].is_string() || !value.contains("session"))
        return broken;
    if (value["ramus_autosave"] != kVersion)
        return fail("another version of ramus wrote this recovery file", file_.string(), "open it with that one");
    RAMUS_TRY(saved, session_from_json(value["session"], file_.parent_path(), file_.string()));
    return Snapshot{std::move(saved.session), value["file"].get<std::string>(), value["changes"].get<std::size_t>(),
                    std::chrono::system_clock::time_point(std::chrono::seconds(value["saved"].get<std::int64_t>()))};
}

void Slot::remove() {
    std::error_code ignored;
    if (file_.empty()) return;
    fs::remove(file_, ignored);
    fs::remove(lock_file(), ignored); // while locked: processes that wait for the lock find it deleted
    if (lock_ >= 0) ::close(std::exchange(lock_, -1));
    file_.clear();
}

std::vector<Slot> find_abandoned(const fs::path& folder) {
    std::vector<std::pair<fs::file_time_type, Slot>> found;
    std::error_code error;
    std::vector<fs::path> files;
    if (folder.empty()) return {};
    for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error))
        files.push_back(each->path());
    for (const fs::path& path : files) {
        clear_unfinished(path);
        const bool is_lock = path.extension() == ".lock";
        if (!is_lock && path.extension() != kEnding) continue;
        if (is_lock && fs::exists(fs::path(path).replace_extension(kEnding), error)) continue; // handled with its file
        const fs::path lock_path = fs::path(path).replace_extension(".lock");
        Slot slot(fs::path(path).replace_extension(kEnding), -1);
        slot.lock_ = ::open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (slot.lock_ < 0) continue; // a read-only folder: nothing can be decided
        const Lock lock = try_lock(slot.lock_);
        if (lock == Lock::kTheirs || !still_there(lock_path, slot.lock_)) continue;
        if (!fs::exists(slot.file_, error)) {
            if (lock == Lock::kOurs) slot.remove();
            continue;
        }
        if (lock == Lock::kUnknown && is_alive(process_of(slot.file_))) continue;
        const auto time = fs::last_write_time(slot.file_, error);
        found.emplace_back(time, std::move(slot));
    }
    std::ranges::sort(found, std::ranges::greater{}, [](const auto& pair) { return pair.first; });
    std::vector<Slot> slots;
    for (auto& [time, slot] : found) slots.push_back(std::move(slot));
    return slots;
}

} // namespace autosave

// Used only by the worker's tasks, sequentially, and by take_over() and leave(), which wait for them.
struct Autosaver::Shared {
    fs::path folder;
    std::optional<autosave::Slot> slot;
};

Autosaver::Autosaver(fs::path folder, std::function<void()> wake)
    : shared_(std::make_shared<Shared>(Shared{std::move(folder), {}})), worker_(std::move(wake)) {}

Autosaver::~Autosaver() = default;

std::optional<Error> Autosaver::update(const Document& document, double now) {
    worker_.drain();
    if (document.revision() != seen_) {
        seen_ = document.revision();
        last_ = now;
        if (document.has_unsaved_work()) { // changes of the view alone are not saved
            if (!first_) first_ = now;
        } else {
            first_.reset();
            if (there_) remove();
        }
    }
    if (first_ && wait_seconds(now) <= 0.0) write(document, now);
    return std::exchange(error_, std::nullopt);
}

double Autosaver::wait_seconds(double now) const {
    if (!first_) return std::numeric_limits<double>::infinity();
    const double due = std::max(std::min(last_ + kSettleSeconds, *first_ + kLatestSeconds), started_ + kBetweenSeconds);
    return std::max(0.0, due - now);
}

void Autosaver::write(const Document& document, double now) {
    first_.reset();
    started_ = now;
    there_ = true;
    autosave::Snapshot snapshot{document.session(), document.file(), document.unsaved_changes(),
                                std::chrono::system_clock::now()};
    worker_.start("Saving", [this, shared = shared_, snapshot = std::move(snapshot)](Job&, const Worker::Post& post) {
        Result<void> done;
        if (!shared->slot) {
            if (auto slot = autosave::Slot::take(shared->folder))
                shared->slot.emplace(std::move(*slot));
            else
                done = tl::unexpected(slot.error());
        }
        if (shared->slot) done = shared->slot->write(snapshot);
        post([this, done] {
            if (done)
                told_ = false;
            else if (!std::exchange(told_, true))
                error_ = done.error();
        });
    });
}

void Autosaver::remove() {
    there_ = false;
    worker_.start("Saving", [shared = shared_](Job&, const Worker::Post&) {
        if (!shared->slot) return;
        shared->slot->remove();
        shared->slot.reset();
    });
}

void Autosaver::take_over(autosave::Slot slot) {
    // std::function must be copyable.
    const auto given = std::make_shared<autosave::Slot>(std::move(slot));
    there_ = true;
    worker_.start("Saving", [shared = shared_, given](Job&, const Worker::Post&) {
        if (shared->slot) shared->slot->remove();
        shared->slot.emplace(std::move(*given));
    });
    finish();
}

void Autosaver::leave() {
    first_.reset();
    remove();
    finish();
}

void Autosaver::finish() {
    while (worker_.busy()) {
        worker_.wait(std::chrono::milliseconds(50));
        worker_.drain();
    }
}

} // namespace ramus::app
