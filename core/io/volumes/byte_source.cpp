#include "core/io/volumes/byte_source.h"

#include "core/io/file_format.h"
#include "core/io/input_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <nifti/znzlib.h>
#include <system_error>
#include <utility>

namespace ramus::io {

struct ByteSource::State {
    znzFile file = nullptr;
    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (!znz_isnull(file)) Xznzclose(&file);
    }
};

ByteSource::ByteSource(std::unique_ptr<State> state, std::string name)
    : state_(std::move(state)), name_(std::move(name)) {}
ByteSource::ByteSource(ByteSource&&) noexcept = default;
ByteSource& ByteSource::operator=(ByteSource&&) noexcept = default;
ByteSource::~ByteSource() = default;

namespace {

// Of pipes and devices nothing is known.
double most_bytes_in(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return std::numeric_limits<double>::infinity();
    const auto bytes = static_cast<double>(std::filesystem::file_size(path, error));
    std::array<char, 2> magic{};
    std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
    constexpr double kDeflate = 1032.0; // zlib's documentation, "Maximum Compression Factor"
    return magic[0] == '\x1f' && magic[1] == '\x8b' ? kDeflate * bytes : bytes;
}

} // namespace

Result<ByteSource> ByteSource::open(const std::filesystem::path& path) {
    if (auto possible = check_input(path); !possible) return tl::unexpected(possible.error());
    auto state = std::make_unique<State>();
    errno = 0;
    state->file = znzopen(path.c_str(), "rb", 1);
    if (znz_isnull(state->file))
        return fail(std::string("cannot be opened: ") + std::strerror(errno != 0 ? errno : ENOMEM), path.string(),
                    "check its permissions");
    ByteSource source(std::move(state), path.string());
    source.most_bytes_ = most_bytes_in(path);
    std::string head(kHeadBytes, '\0');
    RAMUS_TRY(got, source.read_some(head.data(), head.size()));
    head.resize(got);
    source.head_ = std::move(head);
    if (source.head_.empty()) return fail("the file is empty", source.name_, "choose another file");
    return source;
}

Result<std::size_t> ByteSource::read_some(void* into, std::size_t bytes) {
    auto* out = static_cast<char*>(into);
    const std::size_t kept = std::min(bytes, head_.size() - head_used_);
    std::memcpy(out, head_.data() + head_used_, kept);
    head_used_ += kept;
    if (kept == bytes) return bytes;
    // In single bytes: told otherwise, the library complains of short reads on standard error.
    const std::size_t got = znzread(out + kept, 1, bytes - kept, state_->file);
    if (got > bytes - kept)
        return fail("the file is damaged: its compressed bytes make no sense", name_, "copy or write it again");
    return kept + got;
}

Result<void> ByteSource::read(void* into, std::size_t bytes) {
    RAMUS_TRY(got, read_some(into, bytes));
    if (got < bytes) return fail("the file ends before all that its header promises", name_, "copy or write it again");
    return {};
}

Result<void> ByteSource::skip(std::uint64_t bytes) {
    std::array<char, 65536> nowhere;
    for (std::uint64_t left = bytes; left > 0;) {
        const std::size_t part = std::min<std::uint64_t>(left, nowhere.size());
        if (auto got = read(nowhere.data(), part); !got) return got;
        left -= part;
    }
    return {};
}

Result<void> ByteSource::check_end() {
    char more = 0;
    if (auto got = read_some(&more, 1); !got) return tl::unexpected(got.error());
    return {};
}

} // namespace ramus::io
