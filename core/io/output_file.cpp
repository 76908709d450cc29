#include "core/io/output_file.h"

#include "core/base/leftovers.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;

std::atomic<unsigned> serial{0};

fs::path folder_of(const fs::path& target) {
    const fs::path folder = target.parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

// The path behind a symbolic link, whether that file exists or not: the output replaces the file and keeps the link. If
// links form a cycle, returns one of the links.
fs::path final_path(const fs::path& target) {
    constexpr int kMostLinks = 40; // the limit of Linux
    std::error_code code;
    fs::path path = fs::absolute(target, code);
    for (int links = 0; links < kMostLinks && fs::is_symlink(path, code); ++links) {
        const fs::path next = fs::read_symlink(path, code);
        if (code) break;
        // Canonical, because ".." after a linked folder refers to the parent of the folder behind the link.
        const fs::path folder = fs::canonical(path.parent_path(), code);
        path = code ? path.parent_path() / next : folder / next;
    }
    return path;
}

bool is_device(const fs::path& path) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    return !code && fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

} // namespace

struct OutputFile::State {
    fs::path asked;        // as the user named it, for messages
    fs::path target;       // final path
    Leftover unfinished;   // the temporary file; empty for a device, and while the file has no name
    bool nameless = false; // the file has no name until finish(), so nothing is left of it however the process ends

    [[nodiscard]] bool has_name() const { return !unfinished.path().empty(); }
    [[nodiscard]] bool rename() {
        const bool ours = is_ours_to_make(target);
        if (::rename(unfinished.path().c_str(), target.c_str()) != 0) return false;
        unfinished.keep();
        if (ours) note_made(target);
        return true;
    }
    [[nodiscard]] bool exchange() const {
        return ::renameat2(AT_FDCWD, unfinished.path().c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0;
    }

    // Calls make(name) with unused names in the folder of the target until it succeeds. Returns 0 or an errno.
    template <class Make> int name_by(const Make& make) {
        // The name does not contain the target's, which may be as long as a name can be. Several attempts, in case an
        // earlier process left a file.
        constexpr int kAttempts = 100;
        const auto held = hold_leftovers(); // end_by_signal() must not run before the file is a Leftover
        int code = EEXIST;
        for (int attempt = 0; attempt < kAttempts && code == EEXIST; ++attempt) {
            const std::string name =
                ".ramus-" + std::to_string(::getpid()) + "-" + std::to_string(serial.fetch_add(1)) + ".part";
            const fs::path path = folder_of(target) / name;
            code = make(path.c_str()) ? 0 : errno;
            if (code == 0) unfinished = Leftover(path, LeftoverKind::kFile);
        }
        return code;
    }
};

namespace {

// -1: the file system has no files without names, or /proc, which is needed to name them, is missing.
int open_nameless(const fs::path& folder) {
#ifdef O_TMPFILE
    if (::access("/proc/self/fd", X_OK) == 0) return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
#endif
    return -1;
}

} // namespace

Result<void> check_output(const fs::path& target, InputKind kind) {
    const std::string where = target.string();
    if (target.empty()) return fail("the output has no name", {}, "give a file name after -o");
    std::error_code code;
    if (fs::is_directory(target, code)) return fail("is a folder", where, "give the name of a file in it");
    const fs::path place = final_path(target);
    if (is_device(place)) return {};
    if (const auto input = input_lost_by(place, kind))
        return fail("would be lost: this run reads it" + (*input == target ? "" : " as " + input->string()), where,
                    "nothing was written to it; give the output another name");
    if (must_stay(place))
        return fail("exists already, and a commands file may only replace files that it created", where,
                    "remove it, or give --overwrite if the commands are your own");
    if (fs::is_symlink(place, code)) return fail("is a link that leads to itself", where, "remove it");
    const fs::path folder = folder_of(place);
    if (!fs::is_directory(folder, code))
        return fail("the folder " + (fs::is_symlink(target, code) ? folder : folder_of(target)).string() +
                        " does not exist",
                    where, "create it first or choose another one");
    if (::access(folder.c_str(), W_OK | X_OK) != 0) return write_error(target, errno);
    if (fs::exists(place, code) && ::access(place.c_str(), W_OK) != 0) return write_error(target, errno);
    return {};
}

OutputFile::OutputFile(int descriptor, std::unique_ptr<State> state)
    : BufferedFile(descriptor), state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

Result<OutputFile> OutputFile::create(const fs::path& target, InputKind kind) {
    if (auto possible = check_output(target, kind); !possible) return tl::unexpected(possible.error());
    auto state = std::make_unique<State>();
    state->asked = target;
    state->target = final_path(target);

    if (is_device(state->target)) {
        const int descriptor = ::open(state->target.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor < 0) return write_error(target, errno);
        return OutputFile(descriptor, std::move(state));
    }
    int descriptor = open_nameless(folder_of(state->target));
    state->nameless = descriptor >= 0;
    const auto open_named = [&](const char* path) {
        descriptor = ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        return descriptor >= 0;
    };
    if (!state->nameless)
        if (const int code = state->name_by(open_named); code != 0) return write_error(target, code);
    forget_input(descriptor);
    OutputFile file(descriptor, std::move(state));
    // The new file gets the permissions of the file that it replaces, as far as this user may set them. Not setuid and
    // setgid: these were granted to the old content.
    struct stat old {};
    if (::stat(file.state_->target.c_str(), &old) == 0) [[maybe_unused]]
        const int ignored = ::fchmod(descriptor, old.st_mode & 0777);
    return file;
}

void OutputFile::finish() {
    if (file_descriptor_ < 0) return;
    flush();
    State& state = *state_;
    if (!failed() && (state.nameless || state.has_name())) keep_error(::fsync(file_descriptor_));
    if (!failed() && state.nameless) {
        const std::string open = "/proc/self/fd/" + std::to_string(file_descriptor_);
        first_error_ = state.name_by(
            [&](const char* path) { return ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, path, AT_SYMLINK_FOLLOW) == 0; });
    }
    close();
}

Result<void> OutputFile::commit() {
    finish();
    return put_in_place();
}

Result<void> OutputFile::put_in_place() {
    const std::unique_ptr<State> state = std::move(state_);
    const auto held = hold_leftovers();
    if (!failed() && state->has_name()) keep_error(state->rename() ? 0 : -1);
    return failed() ? write_error(state->asked, first_error_) : Result<void>();
}

Result<void> commit_both(OutputFile& first, OutputFile& second) {
    first.finish();
    second.finish();
    const std::unique_ptr<OutputFile::State> one = std::move(first.state_), two = std::move(second.state_);
    if (first.failed()) return write_error(one->asked, first.first_error_);
    if (second.failed()) return write_error(two->asked, second.first_error_);
    const auto held = hold_leftovers();
    const bool first_ours = is_ours_to_make(one->target);
    // Exchanges the names, if the file system can, so that an existing first file can be put back.
    const bool named = one->has_name(), exchanged = named && one->exchange();
    if (named && !exchanged) {
        first.keep_error(one->rename() ? 0 : -1);
        if (first.failed()) return write_error(one->asked, first.first_error_);
    }
    if (two->has_name()) second.keep_error(two->rename() ? 0 : -1);
    if (!second.failed()) {
        if (first_ours) note_made(one->target);
        return {};
    }
    if (exchanged)
        (void)one->exchange();
    else if (named)
        ::unlink(one->target.c_str()); // no file was there, or names cannot be exchanged
    return write_error(two->asked, second.first_error_);
}

Result<void> commit_all(std::span<OutputFile> files) {
    for (OutputFile& file : files) file.finish();
    for (const OutputFile& file : files)
        if (file.failed()) return write_error(file.state_->asked, file.first_error_);
    const auto held = hold_leftovers();
    for (OutputFile& file : files)
        if (auto put = file.put_in_place(); !put) return put;
    return {};
}

Result<void> OutputSet::add(const fs::path& target, std::string_view text) {
    if (auto possible = check_output(target); !possible) return possible;
    if (kept_.number() < 0) kept_.reset(open_without_name(folder_of(final_path(target))));
    if (kept_.number() < 0 || !write_all(kept_.number(), text)) return write_error(target, errno);
    files_.push_back({target, text.size()});
    return {};
}

Result<void> OutputSet::commit() {
    std::vector<OutputFile> files;
    std::string part(std::size_t{1} << 20, '\0');
    if (!files_.empty() && ::lseek(kept_.number(), 0, SEEK_SET) != 0) return write_error(files_[0].target, errno);
    for (const One& one : files_) {
        RAMUS_TRY(file, OutputFile::create(one.target));
        for (std::uint64_t left = one.bytes; left > 0;) {
            const ssize_t got = ::read(kept_.number(), part.data(), std::min<std::uint64_t>(left, part.size()));
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return write_error(one.target, got < 0 ? errno : EIO);
            file.write(part.data(), static_cast<std::size_t>(got));
            left -= static_cast<std::uint64_t>(got);
        }
        file.finish(); // closes it: the number of open files is limited
        files.push_back(std::move(file));
    }
    return commit_all(files);
}

Result<void> write_file(const fs::path& target, std::string_view text, InputKind kind) {
    RAMUS_TRY(file, OutputFile::create(target, kind));
    file.write(text);
    return file.commit();
}

Result<void> write_copy(const fs::path& made, const fs::path& target) {
    std::ifstream from(made, std::ios::binary);
    RAMUS_TRY(file, OutputFile::create(target));
    std::string block(std::size_t{1} << 20, '\0');
    while (from.read(block.data(), static_cast<std::streamsize>(block.size())) || from.gcount() > 0)
        file.write({block.data(), static_cast<std::size_t>(from.gcount())});
    return from.eof() ? file.commit() : fail("what was made cannot be read back", target.string());
}

} // namespace ramus::io
