#include "app/panels/folder_listing.h"
#include "tests/support/temporary_folder.h"

#include <atomic>
#include <chrono>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

using namespace ramus;
using app::FolderListing;

namespace {

// Until it has come, as a window does; false: it never came.
bool comes(FolderListing& listing) {
    for (int n = 0; n < 10'000 && listing.reading(); ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        (void)listing.update();
    }
    return !listing.reading();
}

} // namespace

TEST_CASE("a folder is listed with its folders first, by name, without what is hidden") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "z");
    std::ofstream(folder.path() / "b.SWC") << "12345";
    const std::ofstream empty(folder.path() / "a.nii"), hidden(folder.path() / ".hidden.swc");
    std::filesystem::create_symlink(folder.path() / "nowhere", folder.path() / "c.swc");
    const Job job;
    const auto content = FolderListing::content_of(folder.path(), job);
    CHECK(content.problem.empty());
    REQUIRE(content.entries.size() == 4);
    CHECK(content.entries[0].name == "z");
    CHECK(content.entries[0].folder);
    CHECK(content.entries[1].name == "a.nii");
    CHECK(content.entries[2].name == "b.SWC");
    CHECK(content.entries[2].lower_case == "b.swc");
    CHECK(content.entries[2].bytes == 5);
    CHECK(content.entries[3].name == "c.swc");
    CHECK(content.entries[3].bytes == 0); // of a link that leads nowhere nothing is known
}

TEST_CASE("a folder that is not there is told, and a cancelled listing has nothing") {
    const TemporaryFolder folder;
    const std::ofstream file(folder.path() / "a.swc");
    Job job;
    CHECK_FALSE(FolderListing::content_of(folder.path() / "gone", job).problem.empty());
    CHECK(FolderListing::content_of(folder.path(), job).entries.size() == 1);
    job.cancel();
    CHECK(FolderListing::content_of(folder.path(), job).entries.empty());
}

TEST_CASE("of folders that are listed one after the other the last one comes" * doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "many");
    std::filesystem::create_directory(folder.path() / "one");
    for (int n = 0; n < 20'000; ++n) std::ofstream(folder.path() / "many" / (std::to_string(n) + ".swc")).close();
    const std::ofstream file(folder.path() / "one" / "a.swc");
    FolderListing listing;
    std::atomic<int> woken{0};
    listing.wake_by([&] { ++woken; });
    listing.read(folder.path() / "many");
    listing.read(folder.path() / "one");
    REQUIRE(comes(listing));
    REQUIRE(listing.content().entries.size() == 1);
    CHECK(listing.content().entries[0].name == "a.swc");
    CHECK(woken > 0);
    const unsigned version = listing.version();
    listing.read(folder.path() / "many");
    REQUIRE(comes(listing));
    CHECK(listing.version() != version);
    CHECK(listing.content().entries.size() == 20'000);
}
