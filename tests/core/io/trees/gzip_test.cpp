#include "core/io/inflate.h"
#include "core/io/trees/tree_file.h"
#include "tests/support/peak_memory.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <zlib.h>

using namespace ramus;

namespace {

// As gzip writes it.
std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
    std::string small(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(small.data());
    stream.avail_out = static_cast<uInt>(small.size());
    REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
    small.resize(stream.total_out);
    deflateEnd(&stream);
    return small;
}

const std::string kSwcTree = "1 0 0 0 0 2 -1\n2 0 0 0 9 2 1\n3 0 0 4 12 1 2\n";

} // namespace

TEST_CASE("trees of any format are read from gzip, whatever they are called") {
    const TemporaryFolder folder;
    const auto plain = io::parse_tree(kSwcTree, "a.swc");
    REQUIRE(plain.has_value());
    for (const char* name : {"a.swc.gz", "A.SWC.GZ", "a.swc"}) {
        CAPTURE(name);
        CHECK(io::names_tree(name));
        std::ofstream(folder.path() / name, std::ios::binary) << gzipped(kSwcTree);
        const auto tree = io::read_tree(folder.path() / name);
        REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
        CHECK(tree->points == plain->points);
    }
    // Several files one behind the other are one.
    CHECK(io::parse_tree(gzipped(kSwcTree.substr(0, 20)) + gzipped(kSwcTree.substr(20)), "a.swc.gz")->points ==
          plain->points);
    REQUIRE(io::write_tree(*plain, folder.path() / "b.vtp"));
    std::ifstream written(folder.path() / "b.vtp", std::ios::binary);
    const std::string vtp{std::istreambuf_iterator<char>(written), {}};
    CHECK(io::parse_tree(gzipped(vtp), "b.vtp.gz")->points == plain->points);
    CHECK(io::parse_tree(gzipped(vtp), "of any name")->points == plain->points);
    CHECK_FALSE(io::names_tree("a.txt.gz"));
    CHECK_FALSE(io::check_tree_output(folder.path() / "a.swc.gz").has_value()); // read only
}

TEST_CASE("damaged and truncated gzip is told") {
    const std::string whole = gzipped(kSwcTree);
    for (std::size_t size = 3; size < whole.size(); ++size) {
        const auto tree = io::parse_tree(whole.substr(0, size), "a.swc.gz");
        REQUIRE_FALSE(tree.has_value());
        CHECK(tree.error().message().find("compressed data") != std::string::npos);
    }
    std::string damaged = whole;
    damaged[damaged.size() / 2] ^= 0x55;
    CHECK_FALSE(io::parse_tree(damaged, "a.swc.gz").has_value());
    // Errors of the text inside have its lines.
    CHECK(io::parse_tree(gzipped(kSwcTree + "4 0 0 0 0\n"), "a.swc.gz").error().where == "a.swc.gz:4");
}

TEST_CASE("a small file cannot fill the memory by growing") {
    // 400 files of a MiB each, one behind the other: a file of 400 KiB.
    const std::string part = gzipped(std::string(1U << 20, ' '));
    std::string bomb;
    for (int n = 0; n < 400; ++n) bomb += part;
    const test::PeakMemory memory;
    const auto tree = io::parse_tree(bomb, "a.swc.gz");
    REQUIRE_FALSE(tree.has_value());
    CHECK(tree.error().what.find("grow to more than") != std::string::npos);
#ifndef __SANITIZE_ADDRESS__ // that keeps what was freed
    CHECK(memory.grown_mib() <
          2.5 * static_cast<double>(io::inflation_limit(bomb.size()) >> 20)); // a buffer that grows
#endif
    CHECK(io::inflation_limit(1000) == 16U << 20);
}
