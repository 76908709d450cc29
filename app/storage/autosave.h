// Autosave: the session of a running process on the disk, so that nothing is lost when the process is killed; and what
// such processes left behind, to be offered to the next one.
//
// Each process has one file in the folder, NAME.json, and holds a lock on NAME.lock as long as it lives; the system
// gives the lock back however the process ends. So a file whose lock can be had was left behind, and whoever has the
// lock may decide about it: two processes that start at once never offer the same one. Files are whole or not there.
//
// The lock is flock()'s. Where a file system has none, the process id in the file decides.
#pragma once

#include "app/session/session_file.h"
#include "core/base/error.h"
#include "core/base/worker.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::app {

class Document;

namespace autosave {

// What is kept.
struct Snapshot {
    Session session;
    std::filesystem::path file; // the session file that it came from; empty: none
    std::size_t changes = 0;    // since that was saved
    std::chrono::system_clock::time_point saved{};
    bool operator==(const Snapshot&) const = default;
};

// The place of one process among the files: its name and its lock. Movable; what lies there stays when it goes, until
// remove().
class Slot {
public:
    // A new one. The folder is made when it is not there.
    [[nodiscard]] static Result<Slot> take(const std::filesystem::path& folder);
    Slot(Slot&& other) noexcept;
    Slot& operator=(Slot&& other) noexcept;
    ~Slot(); // gives the lock back

    [[nodiscard]] Result<void> write(const Snapshot& snapshot) const; // atomic
    [[nodiscard]] Result<Snapshot> read() const;
    void remove(); // the file and the lock's; nothing can be written any more
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

private:
    friend std::vector<Slot> find_abandoned(const std::filesystem::path& folder);
    Slot(std::filesystem::path file, int lock) : file_(std::move(file)), lock_(lock) {}
    [[nodiscard]] std::filesystem::path lock_file() const;

    std::filesystem::path file_;
    int lock_ = -1; // descriptor
};

// What processes left that are no more, newest first, with their locks. Locks without a file are cleared away.
[[nodiscard]] std::vector<Slot> find_abandoned(const std::filesystem::path& folder);

} // namespace autosave

// Writes a document's session after it changed: when changes have settled, and at most every few seconds. It is written
// on a thread of its own, and removed as soon as there is nothing that a session file does not have.
class Autosaver {
public:
    static constexpr double kSettleSeconds = 0.7;  // after the last change
    static constexpr double kLatestSeconds = 4.0;  // after the first one that is not written, if they never settle
    static constexpr double kBetweenSeconds = 2.0; // two writings

    // An empty folder: nowhere, which is told like a disk that is full. `wake` is called on another thread.
    Autosaver(std::filesystem::path folder, std::function<void()> wake);
    ~Autosaver(); // what was begun is finished; the file stays

    // Call it whenever something may have happened. An error is handed back once, until writing succeeds again.
    [[nodiscard]] std::optional<Error> update(const Document& document, double now);
    [[nodiscard]] double wait_seconds(double now) const; // infinite: nothing is due
    [[nodiscard]] bool busy() const { return worker_.busy(); }

    // From now on writes over what another process left: the session that was recovered from it is the document's.
    void take_over(autosave::Slot slot);
    // The process ends in peace: nothing is left behind.
    void leave();

private:
    struct Shared; // with the worker
    void write(const Document& document, double now);
    void remove();
    void finish(); // waits for the worker

    std::shared_ptr<Shared> shared_;
    std::uint64_t seen_ = 0;      // revision
    std::optional<double> first_; // change that is not written
    double last_ = 0.0;           // change
    double started_ = -1e9;       // the last writing
    bool there_ = false;          // a file of ours, or one on its way
    bool told_ = false;           // of an error
    std::optional<Error> error_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
