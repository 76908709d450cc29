// Real trees and masks that tests look at where they lie beside the checkout, and that no clone has to have. A test
// that misses its file says so: ctest then lists the test as skipped, never as passed.
//   const auto file = shared_data("trees/brain_BG001.swc"); if (!file) return;
#pragma once

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

// Path of a file under RAMUS_SHARED_DATA; without it, the word that tests/CMakeLists.txt makes ctest look for.
inline std::optional<std::filesystem::path> shared_data(const std::string& name) {
    std::filesystem::path path = std::filesystem::path(RAMUS_SHARED_DATA) / name;
    if (std::filesystem::exists(path)) return path;
    std::cout << "SKIPPED: " << path.string() << " is not here" << std::endl;
    return std::nullopt;
}
