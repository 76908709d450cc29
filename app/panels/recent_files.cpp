#include "app/panels/recent_files.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

namespace ramus::app {

namespace fs = std::filesystem;

namespace {

fs::path list_file() {
    if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/')
        return fs::path(state) / "ramus" / "recent";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
        return fs::path(home) / ".local" / "state" / "ramus" / "recent";
    return {};
}

std::vector<fs::path> read_list() {
    std::vector<fs::path> files;
    std::ifstream stream(list_file());
    for (std::string line; files.size() < kRecentFiles && std::getline(stream, line);) {
        std::error_code ignored;
        if (!line.empty() && fs::exists(line, ignored)) files.emplace_back(line);
    }
    return files;
}

std::vector<fs::path>& list() {
    static std::vector<fs::path> files = read_list();
    return files;
}

} // namespace

const std::vector<fs::path>& recent_files() { return list(); }

void remember_file(const fs::path& path) {
    const fs::path file = fs::absolute(path).lexically_normal();
    auto files = read_list(); // another window may have written in between
    std::erase(files, file);
    files.insert(files.begin(), file);
    if (files.size() > kRecentFiles) files.resize(kRecentFiles);
    list() = files;
    const fs::path target = list_file();
    if (target.empty()) return;
    std::error_code ignored;
    fs::create_directories(target.parent_path(), ignored);
    const fs::path beside = target.string() + ".part";
    {
        std::ofstream stream(beside);
        for (const fs::path& each : files) stream << each.string() << '\n';
        if (!stream) return;
    }
    fs::rename(beside, target, ignored);
}

} // namespace ramus::app
