#include "core/io/checksum.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

using namespace ramus;
namespace fs = std::filesystem;

TEST_CASE("SHA-256 is that of FIPS 180-4") {
    TemporaryFolder folder;
    // The examples of the standard, and no bytes at all.
    for (const auto& [text, sum] :
         {std::pair<std::string, std::string>{"abc",
                                              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
          {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
           "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
          {std::string(1'000'000, 'a'), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"},
          {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"}})
        CHECK(io::sha256_of(folder.write("file", text)).value() == sum);
    const auto missing = io::sha256_of(folder.path() / "missing.swc");
    REQUIRE_FALSE(missing);
    CHECK(missing.error().where.find("missing.swc") != std::string::npos);
}

TEST_CASE("the checksum of a folder is that of the list that sha256sum makes of its files") {
    TemporaryFolder folder, list;
    fs::create_directory(folder.path() / "b");
    folder.write("b/2", "abc");
    folder.write("a", "");
    const fs::path lines =
        list.write("list", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855  a\n"
                           "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  b/2\n");
    CHECK(io::sha256_of(folder.path()).value() == io::sha256_of(lines).value());
}

TEST_CASE("files that are read along with another one are known") {
    TemporaryFolder folder;
    const auto read_with = [&](const std::string& name) {
        std::vector<std::string> names;
        for (const fs::path& file : io::files_read_with(folder.path() / name))
            names.push_back(file.filename().string());
        return names;
    };
    using Names = std::vector<std::string>;
    folder.write("tree.swc", "1 0 0 0 0 1 -1\n");
    CHECK(read_with("tree.swc") == Names{"tree.swc"});
    CHECK(read_with("missing.swc").empty());
    folder.write("liver_edges.csv", "");
    folder.write("liver.csv", "");
    CHECK(read_with("liver.csv") == Names{"liver.csv", "liver_edges.csv"});
    folder.write("mask.raw", "x");
    folder.write("mask.mhd", "NDims = 3\nElementDataFile = mask.raw\n");
    CHECK(read_with("mask.mhd") == Names{"mask.mhd", "mask.raw"});
    folder.write("mask.nhdr", "NRRD0004\nencoding: raw\ndata file: mask.raw\r\n");
    CHECK(read_with("mask.nhdr") == Names{"mask.nhdr", "mask.raw"});
    folder.write("mask.mha", "ElementDataFile = LOCAL\n");
    CHECK(read_with("mask.mha") == Names{"mask.mha"});
}
