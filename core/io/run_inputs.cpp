#include "core/io/run_inputs.h"

#include <atomic>
#include <fcntl.h>
#include <map>
#include <mutex>
#include <set>
#include <sys/stat.h>
#include <tuple>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;

struct Identity {
    std::uint64_t device = 0, inode = 0;
    std::int64_t born_ns = 0; // 0: the file system does not tell
    bool operator<(const Identity& other) const {
        return std::tie(device, inode, born_ns) < std::tie(other.device, other.inode, other.born_ns);
    }
};

struct Input {
    fs::path file;
    InputKind kind = InputKind::kFile;
};

struct Register {
    std::mutex mutex;
    std::map<Identity, Input> inputs;
    std::set<Identity> made;
};

std::atomic<int> keepers{0};

Register& inputs_of_this_run() {
    static Register known;
    return known;
}

// The identity of a regular file. If `name` is empty, that of the descriptor.
std::optional<Identity> identity_of(int folder_or_descriptor, const char* name) {
    struct statx found {};
    if (::statx(folder_or_descriptor, name, AT_EMPTY_PATH, STATX_BASIC_STATS | STATX_BTIME, &found) != 0 ||
        !S_ISREG(found.stx_mode))
        return std::nullopt;
    constexpr std::int64_t kNanoseconds = 1'000'000'000;
    const bool told = (found.stx_mask & STATX_BTIME) != 0;
    return Identity{(std::uint64_t{found.stx_dev_major} << 32) | found.stx_dev_minor, found.stx_ino,
                    told ? found.stx_btime.tv_sec * kNanoseconds + found.stx_btime.tv_nsec : 0};
}

} // namespace

void note_input(const fs::path& file, InputKind kind) {
    if (file.empty()) return;
    const auto identity = identity_of(AT_FDCWD, file.c_str());
    if (!identity) return;
    Register& known = inputs_of_this_run();
    const std::scoped_lock lock(known.mutex);
    const auto [entry, is_new] = known.inputs.try_emplace(*identity, Input{file, kind});
    if (!is_new && kind == InputKind::kFile) entry->second.kind = kind;
}

std::optional<fs::path> input_lost_by(const fs::path& target, InputKind kind) {
    const auto identity = identity_of(AT_FDCWD, target.c_str());
    if (!identity) return std::nullopt;
    Register& known = inputs_of_this_run();
    const std::scoped_lock lock(known.mutex);
    const auto found = known.inputs.find(*identity);
    if (found == known.inputs.end()) return std::nullopt;
    const bool saved_again = kind == InputKind::kSession && found->second.kind == InputKind::kSession;
    return saved_again ? std::nullopt : std::optional(found->second.file);
}

KeepExistingFiles::KeepExistingFiles(bool keep) : keep_(keep) {
    if (keep_) ++keepers;
}
KeepExistingFiles::~KeepExistingFiles() {
    if (keep_) --keepers;
}

bool keeps_existing_files() { return keepers.load() > 0; }

bool must_stay(const fs::path& target) { return keeps_existing_files() && !is_ours_to_make(target); }

bool is_ours_to_make(const fs::path& target) {
    const auto identity = identity_of(AT_FDCWD, target.c_str());
    if (!identity) return true; // nothing, or a device
    Register& known = inputs_of_this_run();
    const std::scoped_lock lock(known.mutex);
    return known.made.contains(*identity);
}

void note_made(const fs::path& file) {
    const auto identity = identity_of(AT_FDCWD, file.c_str());
    if (!identity) return;
    Register& known = inputs_of_this_run();
    const std::scoped_lock lock(known.mutex);
    known.made.insert(*identity);
}

void forget_input(int descriptor) {
    const auto identity = identity_of(descriptor, "");
    if (!identity) return;
    Register& known = inputs_of_this_run();
    const std::scoped_lock lock(known.mutex);
    known.inputs.erase(*identity);
}

} // namespace ramus::io
