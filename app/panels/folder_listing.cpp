#include "app/panels/folder_listing.h"

#include "app/session/numbers.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

namespace ramus::app {

namespace fs = std::filesystem;

namespace {

std::string changed_text(const fs::directory_entry& entry) {
    std::error_code error;
    const fs::file_time_type written = entry.last_write_time(error);
    return error ? std::string() : local_time_text(std::chrono::file_clock::to_sys(written));
}

} // namespace

FolderListing::Content FolderListing::content_of(const fs::path& folder, const Job& job) {
    Content content;
    std::error_code error;
    fs::directory_iterator each(folder, fs::directory_options::skip_permission_denied, error);
    if (error) {
        content.problem = error.message();
        return content;
    }
    for (; !error && each != fs::directory_iterator(); each.increment(error)) {
        if (job.cancelled()) return {};
        std::error_code ignored;
        Entry entry{each->path().filename().string(), {}, each->is_directory(ignored), 0, {}};
        if (entry.name.starts_with(".")) continue;
        entry.lower_case = io::lower_case(entry.name);
        if (!entry.folder) entry.bytes = each->file_size(ignored);
        if (ignored) entry.bytes = 0; // deleted meanwhile, or not a regular file
        entry.changed = changed_text(*each);
        content.entries.push_back(std::move(entry));
    }
    std::ranges::sort(content.entries,
                      [](const Entry& a, const Entry& b) { return a.folder != b.folder ? a.folder : a.name < b.name; });
    return content;
}

void FolderListing::read(const fs::path& folder) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kAtOnce{15}; // within a frame
    content_ = {};
    ++version_;
    reading_ = true;
    if (!worker_)
        worker_ = std::make_unique<Worker>([this] {
            if (wake_) wake_(); // not set for pictures of the window
        });
    worker_->start("Listing the folder", [this, folder](Job& job, const Worker::Post& post) {
        auto read = std::make_shared<Content>(content_of(folder, job));
        post([this, read] {
            content_ = std::move(*read);
            reading_ = false;
            ++version_;
        });
    });
    const Clock::time_point end = Clock::now() + kAtOnce;
    while (reading_ && Clock::now() < end) {
        worker_->wait(std::chrono::milliseconds(1));
        (void)update();
    }
}

bool FolderListing::update() {
    if (!worker_) return false;
    const unsigned before = version_;
    worker_->drain();
    if (std::string failure = worker_->take_failure(); !failure.empty()) {
        content_.problem = std::move(failure);
        reading_ = false;
        ++version_;
    }
    return version_ != before;
}

} // namespace ramus::app
