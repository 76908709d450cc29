#include "core/io/volumes/byte_stage.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>
#include <zlib.h>

namespace ramus::io {

namespace {

class FileStage : public ByteStage {
public:
    explicit FileStage(std::FILE* file) : file_(file) {}
    ~FileStage() override { std::fclose(file_); }
    Result<std::size_t> read(char* into, std::size_t bytes) override {
        const std::size_t got = std::fread(into, 1, bytes, file_);
        if (got < bytes && std::ferror(file_) != 0)
            return fail("reading stopped with an error", {}, "check the medium");
        return got;
    }

private:
    std::FILE* file_;
};

class MemoryStage : public ByteStage {
public:
    explicit MemoryStage(std::string_view bytes) : left_(bytes) {}
    Result<std::size_t> read(char* into, std::size_t bytes) override {
        const std::size_t got = std::min(bytes, left_.size());
        std::copy_n(left_.data(), got, into);
        left_.remove_prefix(got);
        return got;
    }

private:
    std::string_view left_;
};

class InflateStage : public ByteStage {
public:
    InflateStage(std::string first, std::unique_ptr<ByteStage> rest)
        : rest_(std::move(rest)), input_(first.begin(), first.end()) {
        constexpr int kGzipOrZlib = 15 + 32; // zlib.h, inflateInit2
        ready_ = inflateInit2(&stream_, kGzipOrZlib) == Z_OK;
        take(input_.size());
    }
    ~InflateStage() override {
        if (ready_) inflateEnd(&stream_);
    }

    Result<std::size_t> read(char* into, std::size_t bytes) override {
        if (!ready_) return fail("not enough memory to undo its compression", {}, "free some memory");
        const auto wanted = static_cast<uInt>(std::min<std::size_t>(bytes, std::numeric_limits<uInt>::max()));
        stream_.next_out = reinterpret_cast<Bytef*>(into);
        stream_.avail_out = wanted;
        while (stream_.avail_out > 0 && !ended_) {
            RAMUS_TRY(some, more_input());
            if (!some) return fail("the file ends within its compressed bytes", {}, "copy or write it again");
            const int status = inflate(&stream_, Z_NO_FLUSH);
            if (status == Z_STREAM_END) {
                RAMUS_TRY(another, another_begins());
                ended_ = !another;
            } else if (status != Z_OK && status != Z_BUF_ERROR) {
                return fail("the file is damaged: its compressed bytes make no sense", {}, "copy or write it again");
            }
        }
        return wanted - stream_.avail_out;
    }

private:
    void take(std::size_t bytes) {
        stream_.next_in = input_.data();
        stream_.avail_in = static_cast<uInt>(bytes);
    }

    // Whether there is any input.
    Result<bool> more_input() {
        if (stream_.avail_in > 0) return true;
        input_.resize(std::size_t{1} << 16);
        RAMUS_TRY(got, rest_->read(reinterpret_cast<char*>(input_.data()), input_.size()));
        take(got);
        return got > 0;
    }

    // After a gzip stream another may follow. Other bytes there are padding.
    Result<bool> another_begins() {
        RAMUS_TRY(some, more_input());
        if (!some || *stream_.next_in != 0x1f) return false;
        return inflateReset(&stream_) == Z_OK;
    }

    std::unique_ptr<ByteStage> rest_;
    std::vector<Bytef> input_;
    z_stream stream_{};
    bool ready_ = false, ended_ = false;
};

} // namespace

Result<std::unique_ptr<ByteStage>> file_stage(const std::filesystem::path& path) {
    errno = 0;
    std::FILE* file = std::fopen(path.c_str(), "rb");
    if (file == nullptr)
        return fail(std::string("cannot be opened: ") + std::strerror(errno != 0 ? errno : ENOMEM), {},
                    "check its permissions");
    return std::make_unique<FileStage>(file);
}

std::unique_ptr<ByteStage> memory_stage(std::string_view bytes) { return std::make_unique<MemoryStage>(bytes); }

std::unique_ptr<ByteStage> inflate_stage(std::string first, std::unique_ptr<ByteStage> rest) {
    return std::make_unique<InflateStage>(std::move(first), std::move(rest));
}

} // namespace ramus::io
