#include "app/commands/output_target.h"

#include "app/commands/command.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/trees/tree_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <unistd.h>
#include <utility>

namespace ramus::app {

namespace {

constexpr const char* kStandardOutput = "standard output";

Result<void> copy_to_standard_output(int file) {
    std::array<char, std::size_t{1} << 16> buffer;
    while (true) {
        const ssize_t got = ::read(file, buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            return fail(std::string("what was written cannot be read: ") + std::strerror(errno), kStandardOutput);
        if (got == 0) return {};
        for (ssize_t done = 0; done < got;) {
            const ssize_t put = ::write(STDOUT_FILENO, buffer.data() + done, static_cast<std::size_t>(got - done));
            if (put < 0 && errno == EINTR) continue;
            if (put < 0) return fail(std::string("cannot be written: ") + std::strerror(errno), kStandardOutput);
            done += put;
        }
    }
}

} // namespace

bool is_standard_output(const std::filesystem::path& output) { return output == "-" || output == "/dev/stdout"; }

std::string output_name(const std::filesystem::path& file) {
    return file.stem() == kStandardOutput ? kStandardOutput : file.string();
}

std::vector<std::string_view> streamed_tree_extensions() {
    std::vector<std::string_view> extensions = io::writable_extensions(io::tree_formats());
    std::erase(extensions, ".csv");
    return extensions;
}

std::vector<std::string_view> streamed_mesh_extensions() {
    std::vector<io::MeshFormat> formats = io::mesh_formats();
    std::erase_if(formats, [](const io::MeshFormat& format) { return format.in_files; });
    return io::writable_extensions(formats);
}

void add_format_flag(CLI::App& command, std::string& format, const std::vector<std::string_view>& extensions) {
    const std::string listed = io::listed(extensions);
    const auto is_listed = [extensions](const std::string& word) {
        return std::ranges::find(extensions, word.starts_with('.') ? word : "." + word) != extensions.end();
    };
    add_option(command, "--format", "EXT", format,
               "Of standard output, which -o - writes to: its format, as an extension (" + listed + ")")
        ->check(expecting(" is not " + listed + ", the formats that standard output can have", is_listed));
}

void check_output_flags(const CLI::App& command, const std::filesystem::path& output, const std::string& format) {
    const auto count = [&](const char* name) {
        const CLI::Option* option = command.get_option_no_throw(name);
        return option == nullptr ? 0 : option->count();
    };
    if (!is_standard_output(output)) {
        if (!format.empty())
            throw CLI::ValidationError("--format", "has a meaning only with -o -; a file's format is its extension");
        return;
    }
    if (command.get_option_no_throw("--format") != nullptr && format.empty())
        throw CLI::ValidationError("-o", "standard output has no extension; say with --format what it is written as");
    if (count("--json") > 0)
        throw CLI::ValidationError("--json", "prints to standard output, where -o " + output.string() + " writes");
}

Result<OutputTarget> OutputTarget::of(const std::filesystem::path& output, const std::string& format) {
    OutputTarget target;
    target.file_ = output;
    if (!is_standard_output(output)) return target;
    if (::isatty(STDOUT_FILENO) != 0)
        return fail("is a terminal", kStandardOutput, "send it to a pipe or a file, or name a file after -o");
    RAMUS_TRY(folder, ScratchFolder::create());
    target.file_ = folder.path() / ("standard output" + (format.starts_with('.') ? format : "." + format));
    target.scratch_.emplace(std::move(folder));
    return target;
}

Result<void> OutputTarget::deliver() {
    if (!scratch_) return {};
    const int file = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return fail(std::string("what was written cannot be read: ") + std::strerror(errno), kStandardOutput);
    scratch_.reset(); // before a reader that has gone may end this process
    auto copied = copy_to_standard_output(file);
    ::close(file);
    return copied;
}

SentencesToStandardError::SentencesToStandardError() : before_(std::cout.rdbuf(std::cerr.rdbuf())) {}
SentencesToStandardError::~SentencesToStandardError() { std::cout.rdbuf(before_); }

} // namespace ramus::app
