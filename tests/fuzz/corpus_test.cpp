// What scripts/fuzz begins with, and what it has found: every file of tests/fuzz/corpus goes through its target.
#include "tests/fuzz/target.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace ramus;

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::string& target) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::path(RAMUS_FUZZ_CORPUS) / target, error))
        files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

} // namespace

TEST_CASE("every target has files to begin with, and takes them all, whole and cut short") {
    for (const fuzz::Target& target : fuzz::targets()) {
        CAPTURE(target.name);
        const auto files = files_of(target.name);
        CHECK_FALSE(files.empty());
        for (const fs::path& path : files) {
            CAPTURE(path.filename().string());
            std::ifstream file(path, std::ios::binary);
            const std::string bytes{std::istreambuf_iterator<char>(file), {}};
            CHECK_NOTHROW(target.run(bytes));
            for (std::size_t part = 0; part < 20; ++part) {
                CAPTURE(part);
                CHECK_NOTHROW(target.run(std::string_view(bytes).substr(0, bytes.size() * part / 20)));
            }
        }
    }
}

TEST_CASE("every folder of the corpus is of a target") {
    for (const auto& entry : fs::directory_iterator(RAMUS_FUZZ_CORPUS)) {
        CAPTURE(entry.path().string());
        CHECK(std::ranges::count(fuzz::targets(), entry.path().filename().string(), &fuzz::Target::name) == 1);
    }
}
