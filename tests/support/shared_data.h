// Real trees and masks live beside the checkout, not in it. Tests on them say so and pass where there are none.
#pragma once

#include <doctest/doctest.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ramus::test {

// All SWC files of the shared data, sorted; empty (with a visible word) in a plain clone.
inline std::vector<std::filesystem::path> shared_trees() {
    const std::filesystem::path folder = std::filesystem::path(RAMUS_SHARED_DATA) / "trees";
    std::vector<std::filesystem::path> trees;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (entry.path().extension() == ".swc") trees.push_back(entry.path());
    std::sort(trees.begin(), trees.end());
    if (trees.empty()) MESSAGE("SKIPPED: no real trees in " << folder.string());
    return trees;
}

// A file of one folder of the shared data; none (with a visible word) in a plain clone.
inline std::optional<std::filesystem::path> shared_file(const char* folder, const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(RAMUS_SHARED_DATA) / folder / name;
    std::error_code error;
    if (std::filesystem::exists(path, error)) return path;
    MESSAGE("SKIPPED: there is no " << path.string());
    return std::nullopt;
}

inline std::optional<std::filesystem::path> shared_volume(const std::string& name) {
    return shared_file("volumes", name);
}

} // namespace ramus::test
