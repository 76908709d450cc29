// Autosave: writes the session of a running process to disk, so that nothing is lost if the process is killed, and
// finds what killed processes left, to offer it to the next one.
//
// Each process has one file NAME.json in the folder and holds a lock on NAME.lock while it runs; the system releases
// the lock however the process ends. A file whose lock is free is abandoned, and the process that acquires the lock
// decides about it, so two processes never offer the same file. Files are complete or absent. The lock uses flock(); on
// file systems without it the process id in the file decides.
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

// The saved data.
struct Snapshot {
    Session session;
    std::filesystem::path file; // the session file it belongs to; empty: none
    std::size_t changes = 0;    // since `file` was saved
    std::chrono::system_clock::time_point saved{};
    bool operator==(const Snapshot&) const = default;
};

// A process's file and lock. Movable. Destruction keeps the file unless remove() was called.
class Slot {
public:
    // Creates a new slot, and the folder if necessary.
    [[nodiscard]] static Result<Slot> take(const std::filesystem::path& folder);
    Slot(Slot&& other) noexcept;
    Slot& operator=(Slot&& other) noexcept;
    ~Slot(); // releases the lock

    [[nodiscard]] Result<void> write(const Snapshot& snapshot) const; // atomic
    [[nodiscard]] Result<Snapshot> read() const;
    void remove(); // deletes file and lock; write() then fails
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

private:
    friend std::vector<Slot> find_abandoned(const std::filesystem::path& folder);
    Slot(std::filesystem::path file, int lock) : file_(std::move(file)), lock_(lock) {}
    [[nodiscard]] std::filesystem::path lock_file() const;

    std::filesystem::path file_;
    int lock_ = -1; // descriptor
};

// Files of terminated processes, newest first, with their locks acquired. Deletes locks without a file.
[[nodiscard]] std::vector<Slot> find_abandoned(const std::filesystem::path& folder);

} // namespace autosave

// Autosaver: writes a document's session after changes have settled, at most every few seconds, on a worker thread.
// Removes the file as soon as everything is saved in a session file.
class Autosaver {
public:
    static constexpr double kSettleSeconds = 0.7;  // after the last change
    static constexpr double kLatestSeconds = 4.0;  // after the first unsaved change, if changes never settle
    static constexpr double kBetweenSeconds = 2.0; // between two writes

    // An empty folder means that there is none, which is reported like a full disk. `wake`: called on another thread.
    Autosaver(std::filesystem::path folder, std::function<void()> wake);
    ~Autosaver(); // finishes a running write; the file stays

    // Call whenever something may have changed. Returns an error once, until writing succeeds again.
    [[nodiscard]] std::optional<Error> update(const Document& document, double now);
    [[nodiscard]] double wait_seconds(double now) const; // infinite: nothing is due
    [[nodiscard]] bool busy() const { return worker_.busy(); }

    // From now on uses the slot of another process, whose session was recovered into the document.
    void take_over(autosave::Slot slot);
    // Removes the file; call when the process ends normally.
    void leave();

private:
    struct Shared; // shared with the worker
    void write(const Document& document, double now);
    void remove();
    void finish(); // waits for the worker

    std::shared_ptr<Shared> shared_;
    std::uint64_t seen_ = 0;      // revision
    std::optional<double> first_; // time of the first unsaved change
    double last_ = 0.0;           // time of the last change
    double started_ = -1e9;       // time of the last write
    bool there_ = false;          // our file exists or is being written
    bool told_ = false;           // the error was returned
    std::optional<Error> error_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
