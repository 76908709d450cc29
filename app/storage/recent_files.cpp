#include "app/storage/recent_files.h"

#include "app/storage/user_folders.h"
#include "core/io/output_file.h"

#include <fstream>
#include <string>

namespace ramus::app {

namespace fs = std::filesystem;

namespace {

fs::path list_file() {
    const fs::path folder = user_folders::state();
    return folder.empty() ? folder : folder / "recent";
}

} // namespace

std::vector<fs::path> read_recent_files() {
    std::vector<fs::path> files;
    constexpr std::size_t kMost = 100;
    std::ifstream stream(list_file());
    for (std::string line; files.size() < kMost && std::getline(stream, line);) {
        std::error_code ignored;
        if (!line.empty() && fs::exists(line, ignored)) files.emplace_back(line);
    }
    return files;
}

std::vector<fs::path> remember_file(const fs::path& path, std::size_t most) {
    const fs::path file = fs::absolute(path).lexically_normal();
    auto files = read_recent_files(); // another window may have written in between
    std::erase(files, file);
    files.insert(files.begin(), file);
    if (files.size() > most) files.resize(most);
    const fs::path target = list_file();
    if (target.empty()) return files;
    (void)user_folders::make_private(target.parent_path());
    std::string text;
    for (const fs::path& each : files)
        if (each.string().find('\n') == std::string::npos) text += each.string() + "\n";
    (void)io::write_file(target, text);
    return files;
}

} // namespace ramus::app
