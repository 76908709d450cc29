#include "core/io/volumes/byte_source.h"
#include "tests/support/volume_files.h"

#include <doctest/doctest.h>

using namespace ramus;

namespace {

std::string rest_of(io::ByteSource& source) {
    std::string text(100000, '\0');
    const auto got = source.read_some(text.data(), text.size());
    REQUIRE(got);
    text.resize(*got);
    return text;
}

} // namespace

TEST_CASE("bytes come as they are from files and from memory, or unpacked") {
    const TemporaryFolder folder;
    std::string text;
    for (int n = 0; n < 3000; ++n) text += std::to_string(n) + (n % 7 == 0 ? "\r\n" : "\n");
    const std::string gzip = test::compressed(text, test::Wrapper::kGzip);
    // Several streams of gzip one behind the other are one file; what is no gzip behind them belongs to no one.
    const std::string twice = gzip + test::compressed("end", test::Wrapper::kGzip) + "padding";
    for (const auto& [bytes, expected] : {std::pair{text, text}, {gzip, text}, {twice, text + "end"}}) {
        auto file = io::ByteSource::open(folder.write("a", bytes));
        auto memory = io::ByteSource::of_memory(bytes, "a");
        REQUIRE(file);
        REQUIRE(memory);
        CHECK(file->is_gzip() == (&bytes != &text && bytes != text));
        CHECK(file->exact_bytes().has_value() == (bytes == text));
        CHECK(file->most_bytes() >= static_cast<double>(expected.size()));
        CHECK(memory->most_bytes() == file->most_bytes());
        CHECK(file->head() == expected.substr(0, io::kHeadBytes));
        CHECK(rest_of(*file) == expected);
        CHECK(rest_of(*memory) == expected);
        CHECK(file->check_end());
        CHECK(memory->path().empty());
    }
    auto as_it_is = io::ByteSource::open(folder.write("a", gzip), io::Unpack::kNothing);
    CHECK(rest_of(*as_it_is) == gzip);
    CHECK(io::ByteSource::of_memory("", "a").error().what == "the file is empty");
}

TEST_CASE("lines are read one by one, and what follows them may be compressed") {
    for (const test::Wrapper wrapper : {test::Wrapper::kZlib, test::Wrapper::kGzip}) {
        const std::string values(70000, 'v');
        const std::string bytes = "one\r\n\ntwo\n" + test::compressed(values, wrapper);
        auto source = io::ByteSource::of_memory(bytes, "a");
        REQUIRE(source);
        std::string line;
        CHECK(*source->read_line(line, 100));
        CHECK(line == "one");
        CHECK(*source->read_line(line, 100));
        CHECK(line.empty());
        CHECK(*source->read_line(line, 100));
        CHECK(line == "two");
        source->inflate_rest();
        CHECK(rest_of(*source) == values);
        CHECK_FALSE(*source->read_line(line, 100));

        auto cut = io::ByteSource::of_memory(std::string_view(bytes).substr(0, bytes.size() - 2), "a");
        CHECK(cut->skip(10));
        cut->inflate_rest();
        std::string all(values.size(), '\0');
        CHECK(cut->read(all.data(), all.size()));
        CHECK(cut->check_end().error().what == "the file ends within its compressed bytes");
    }
    auto endless = io::ByteSource::of_memory(std::string_view("no line feed to be seen"), "a");
    std::string line;
    CHECK(endless->read_line(line, 10).error().what.find("longer than 10") != std::string::npos);
    CHECK_FALSE(*endless->read_line(line, 10)); // it is used up
}
