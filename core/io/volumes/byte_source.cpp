#include "core/io/volumes/byte_source.h"

#include "core/io/file_format.h"
#include "core/io/input_file.h"
#include "core/io/run_inputs.h"
#include "core/io/standard_input.h"
#include "core/io/volumes/byte_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

namespace ramus::io {

struct ByteSource::State {
    std::unique_ptr<ByteStage> stage;
    std::string buffer; // read from the stage; used up to `at`
    std::size_t at = 0;
};

ByteSource::ByteSource(std::unique_ptr<State> state, std::string name)
    : state_(std::move(state)), name_(std::move(name)) {}
ByteSource::ByteSource(ByteSource&&) noexcept = default;
ByteSource& ByteSource::operator=(ByteSource&&) noexcept = default;
ByteSource::~ByteSource() = default;

namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 16;
constexpr double kDeflate = 1032.0; // zlib's documentation, "Maximum Compression Factor"

Result<std::size_t> named(Result<std::size_t> got, const std::string& name) {
    if (!got) got.error().where = name;
    return got;
}

} // namespace

Result<ByteSource> ByteSource::open(const std::filesystem::path& path, Unpack unpack) {
    if (auto possible = check_input(path); !possible) return tl::unexpected(possible.error());
    auto state = std::make_unique<State>();
    auto stage = file_stage(path);
    if (!stage) return fail(stage.error().what, input_name(path), stage.error().hint);
    state->stage = std::move(*stage);
    note_input(path);
    // The size of pipes and devices is unknown.
    std::error_code error;
    const double bytes = std::filesystem::is_regular_file(path, error)
                             ? static_cast<double>(std::filesystem::file_size(path, error))
                             : std::numeric_limits<double>::infinity();
    ByteSource source(std::move(state), input_name(path));
    if (!is_standard_input(path)) source.path_ = path;
    if (auto begun = source.begin(bytes, unpack); !begun) return tl::unexpected(begun.error());
    return source;
}

Result<ByteSource> ByteSource::of_memory(std::string_view bytes, std::string name) {
    auto state = std::make_unique<State>();
    state->stage = memory_stage(bytes);
    ByteSource source(std::move(state), std::move(name));
    if (auto begun = source.begin(static_cast<double>(bytes.size()), Unpack::kGzip); !begun)
        return tl::unexpected(begun.error());
    return source;
}

Result<ByteSource> ByteSource::of_stage(std::unique_ptr<ByteStage> stage, std::string name, double most_bytes) {
    auto state = std::make_unique<State>();
    state->stage = std::move(stage);
    ByteSource source(std::move(state), std::move(name));
    if (auto begun = source.begin(most_bytes, Unpack::kNothing); !begun) return tl::unexpected(begun.error());
    return source;
}

Result<void> ByteSource::begin(double file_bytes, Unpack unpack) {
    most_bytes_ = file_bytes;
    exact_ = std::isfinite(file_bytes);
    if (auto filled = fill(); !filled) return filled;
    gzip_ = unpack == Unpack::kGzip && state_->buffer.starts_with("\x1f\x8b");
    if (gzip_) {
        inflate_rest();
        if (auto filled = fill(); !filled) return filled;
    }
    head_ = state_->buffer.substr(0, kHeadBytes);
    if (head_.empty()) return fail("the file is empty", name_, "choose another file");
    return {};
}

// Fills the buffer again when all of it is used. An empty buffer then means the end.
Result<void> ByteSource::fill() {
    state_->buffer.resize(kBuffer);
    state_->at = 0;
    auto got = named(state_->stage->read(state_->buffer.data(), kBuffer), name_);
    state_->buffer.resize(got.value_or(0));
    if (!got) return tl::unexpected(got.error());
    return {};
}

void ByteSource::inflate_rest() {
    most_bytes_ = kDeflate * most_bytes();
    exact_ = false;
    used_ = 0;
    state_->stage = inflate_stage(state_->buffer.substr(state_->at), std::move(state_->stage));
    state_->buffer.clear();
    state_->at = 0;
}

std::optional<std::uint64_t> ByteSource::exact_bytes() const {
    if (!exact_) return std::nullopt;
    return static_cast<std::uint64_t>(std::max(most_bytes(), 0.0));
}

Result<std::size_t> ByteSource::read_some(void* into, std::size_t bytes) {
    auto* out = static_cast<char*>(into);
    const std::size_t kept = std::min(bytes, state_->buffer.size() - state_->at);
    state_->buffer.copy(out, kept, state_->at);
    state_->at += kept;
    std::size_t done = kept;
    while (done < bytes) {
        RAMUS_TRY(got, named(state_->stage->read(out + done, bytes - done), name_));
        if (got == 0) break;
        done += got;
    }
    used_ += done;
    return done;
}

Result<void> ByteSource::read(void* into, std::size_t bytes) {
    RAMUS_TRY(got, read_some(into, bytes));
    if (got < bytes) return fail("the file ends before all that its header promises", name_, "copy or write it again");
    return {};
}

Result<bool> ByteSource::read_line(std::string& line, std::size_t limit) {
    line.clear();
    for (bool some = false;; some = true) {
        if (state_->at == state_->buffer.size()) {
            if (auto filled = fill(); !filled) return tl::unexpected(filled.error());
            if (state_->buffer.empty()) return some;
        }
        const std::size_t feed = state_->buffer.find('\n', state_->at);
        const std::size_t end = std::min(feed, state_->buffer.size());
        line.append(state_->buffer, state_->at, end - state_->at);
        const std::size_t next = feed == std::string::npos ? end : end + 1;
        used_ += next - state_->at;
        state_->at = next;
        if (line.size() > limit)
            return fail("a line of its header is longer than " + std::to_string(limit) + " bytes", name_,
                        "write the file again");
        if (feed == std::string::npos) continue;
        if (line.ends_with('\r')) line.pop_back();
        return true;
    }
}

Result<void> ByteSource::skip(std::uint64_t bytes) {
    std::array<char, kBuffer> nowhere;
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
