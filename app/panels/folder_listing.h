// FolderListing: what is in a folder, read beside the window's thread: thousands of files, or a folder on a network,
// take seconds.
#pragma once

#include "core/base/worker.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

class FolderListing {
public:
    struct Entry {
        std::string name, lower_case; // the second to compare with
        bool folder = false;
        std::uintmax_t bytes = 0;
        std::string changed; // "2026-11-28 17:04", local time; empty: not known
    };
    struct Content {
        std::vector<Entry> entries; // folders first, then files, by name
        std::string problem;        // why the folder cannot be listed
    };
    // Of a folder as it is now; hidden files are left out. None of it once the job is cancelled.
    [[nodiscard]] static Content content_of(const std::filesystem::path& folder, const Job& job);

    void wake_by(std::function<void()> wake) { wake_ = std::move(wake); } // called on another thread as it comes
    // Forgets what it has and begins with this one. One that is read at once is there when this returns.
    void read(const std::filesystem::path& folder);
    bool update(); // true: it has come
    [[nodiscard]] bool reading() const { return reading_; }
    [[nodiscard]] const Content& content() const { return content_; }
    [[nodiscard]] unsigned version() const { return version_; } // of the content

private:
    std::function<void()> wake_ = [] {};
    Content content_;
    unsigned version_ = 0;
    bool reading_ = false;
    std::unique_ptr<Worker> worker_; // from the first folder on; last: it uses the above
};

} // namespace ramus::app
