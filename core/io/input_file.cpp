#include "core/io/input_file.h"

#include "core/io/standard_input.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace ramus::io {

namespace {

tl::unexpected<Error> cannot_open(const std::string& name, int number) {
    return fail(std::string("cannot be opened: ") + std::strerror(number != 0 ? number : EIO), name,
                "check its permissions");
}

} // namespace

Result<void> check_input(const std::filesystem::path& path) {
    const std::string name = input_name(path);
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (path == "-" && status.type() == std::filesystem::file_type::not_found)
        return fail("standard input is only for trees, masks and meshes", name, "name a file here");
    if (status.type() == std::filesystem::file_type::not_found) return fail("no such file", name, "check the path");
    if (std::filesystem::is_directory(status))
        return fail("this is a directory, not a file", name, "name a file in it");
    // A device may provide bytes without end, or wait for a keyboard.
    if (status.type() == std::filesystem::file_type::block || status.type() == std::filesystem::file_type::character)
        return fail("this is a device, not a file", name, "name a file, or a pipe");
    // Not opened here, because a pipe can be opened only once.
    if (::access(path.c_str(), R_OK) != 0) return cannot_open(name, errno);
    return {};
}

Result<std::string> read_file(const std::filesystem::path& path, std::uintmax_t limit, InputKind kind) {
    const std::string name = input_name(path);
    if (auto possible = check_input(path); !possible) return tl::unexpected(possible.error());
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) return cannot_open(name, errno);
    note_input(path, kind);
    std::error_code error;
    const bool has_size = std::filesystem::is_regular_file(path, error);
    if (!has_size) limit = std::min(limit, kMostPipeBytes);
    const auto too_large = [&] {
        return fail("the file is larger than " + std::to_string(limit >> 20) + " MiB", name,
                    has_size ? "choose a smaller file" : "write it to a file, and name that");
    };
    std::string text;
    if (has_size) {
        const std::uintmax_t size = std::filesystem::file_size(path, error);
        if (!error && size > limit) return too_large();
        if (!error) text.reserve(size);
    }
    // Reads to the end instead of trusting a size: pipes have none, and files may grow.
    char buffer[1 << 16];
    while (file.read(buffer, sizeof(buffer)) || file.gcount() > 0) {
        text.append(buffer, static_cast<std::size_t>(file.gcount()));
        if (text.size() > limit) return too_large();
    }
    if (file.bad()) return fail("reading stopped with an error", name, "check the medium");
    return text;
}

void split_words(std::string_view text, std::string_view blanks, std::vector<std::string_view>& words) {
    words.clear();
    for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = text.find_first_not_of(blanks, end);
    }
}

} // namespace ramus::io
