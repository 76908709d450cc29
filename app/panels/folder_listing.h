// FolderListing: reads the content of a folder on a worker thread, because thousands of files or network folders take
// seconds. All calls from the owner's thread, except content_of().
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
        std::string name, lower_case; // lower_case: for comparisons
        bool folder = false;
        std::uintmax_t bytes = 0;
        std::string changed; // "2026-11-28 17:04", local time; empty: unknown
    };
    struct Content {
        std::vector<Entry> entries; // folders first, then files, by name
        std::string problem;        // why the folder cannot be listed
    };
    // The current content of a folder without hidden files. Empty if the job is cancelled.
    [[nodiscard]] static Content content_of(const std::filesystem::path& folder, const Job& job);

    void wake_by(std::function<void()> wake) {
        wake_ = std::move(wake);
    } // called on another thread when content arrives
    // Discards the content and reads this folder. Small folders are complete on return.
    void read(const std::filesystem::path& folder);
    bool update(); // true: new content has arrived
    [[nodiscard]] bool reading() const { return reading_; }
    [[nodiscard]] const Content& content() const { return content_; }
    [[nodiscard]] unsigned version() const { return version_; } // of the content

private:
    std::function<void()> wake_ = [] {};
    Content content_;
    unsigned version_ = 0;
    bool reading_ = false;
    std::unique_ptr<Worker> worker_; // from the first folder on; last: its thread uses the members above
};

} // namespace ramus::app
