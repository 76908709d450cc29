#include "core/io/meshes/mesh_file.h"
#include "core/io/recognise.h"
#include "core/io/trees/swc.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/volume_file.h"
#include "tests/support/icosphere.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <array>
#include <doctest/doctest.h>
#include <fstream>
#include <set>

using namespace ramus;

namespace {

// One table after the other, as plain formats.
template <class Visit> void for_each_format(const Visit& visit) {
    for (const auto& format : io::tree_formats()) visit(format);
    for (const auto& format : io::mesh_formats()) visit(format);
    for (const auto& format : io::volume_formats()) visit(format);
}

tree::VesselTree small_tree() {
    return *io::parse_tree("1 0 0 0 0 1 -1\n2 0 0 0 9 1 1\n3 0 3 0 12 0.5 2\n4 0 -3 0 12 0.5 2\n", "small.swc");
}

std::string source_file(const std::string& name) {
    std::ifstream file(std::string(RAMUS_SOURCE_DIR) + "/" + name);
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST_CASE("every format has a name, a sentence of help and extensions that no other has") {
    std::set<std::string_view> names;
    // A .vtp is a tree or a surface: whoever writes or reads one says which.
    std::array<std::set<std::string_view>, 2> extensions; // of trees and volumes; of meshes
    for_each_format([&](const io::FileFormat& format) {
        const auto& meshes = io::mesh_formats();
        const bool is_mesh = std::ranges::any_of(meshes, [&](const auto& each) { return each.name == format.name; });
        CAPTURE(format.name);
        CHECK(names.insert(format.name).second);
        CHECK(format.help.ends_with('.'));
        REQUIRE_FALSE(format.extensions.empty());
        for (const std::string_view extension : format.extensions) {
            CHECK(extension.starts_with('.'));
            CHECK(std::ranges::none_of(extension, [](char c) { return c >= 'A' && c <= 'Z'; }));
            CHECK(extensions[is_mesh ? 1 : 0].insert(extension).second);
        }
    });
    for (const auto& format : io::tree_formats()) CHECK((is_read(format) || is_written(format)));
    for (const auto& format : io::mesh_formats()) {
        CHECK((is_read(format) || is_written(format)));
        CHECK((format.header == nullptr) == (format.triangles == nullptr));
        CHECK((format.header == nullptr || format.whole == nullptr));
    }
}

TEST_CASE("a tree comes back from every tree format that is written and read, under every extension") {
    const TemporaryFolder folder;
    const tree::VesselTree tree = small_tree();
    for (const auto& format : io::tree_formats()) {
        if (!is_read(format) || !is_written(format)) continue;
        for (const std::string_view extension : format.extensions) {
            CAPTURE(extension);
            const auto file = folder.path() / ("tree" + std::string(extension));
            CHECK(io::names_tree(file));
            REQUIRE(io::check_tree_output(file));
            REQUIRE(io::write_tree(tree, file));
            const auto read = io::read_tree(file);
            REQUIRE(read);
            CHECK(read->points == tree.points);
            CHECK(read->branches.size() == tree.branches.size());
            if (format.has_signature == nullptr || format.certainty == io::Certainty::kLikeness) continue;
            // The content decides, whatever the name says.
            for (const char* wrong : {"tree.dat", "wrong.swc", "wrong.json"}) {
                std::filesystem::copy_file(file, folder.path() / wrong,
                                           std::filesystem::copy_options::overwrite_existing);
                CHECK(io::read_tree(folder.path() / wrong).has_value());
            }
        }
    }
}

TEST_CASE("a mesh comes back from every mesh format that is written and read") {
    const TemporaryFolder folder;
    mesh::TriangleMesh ball = test::icosphere(2, {1, 2, 3}, 4.0);
    ball.radii.resize(ball.positions.size(), 1.0F);
    ball.branches.resize(ball.positions.size(), 0);
    for (const auto& format : io::mesh_formats()) {
        if (!is_written(format)) continue;
        const std::string extension(format.extensions.front());
        CAPTURE(extension);
        REQUIRE(io::write_mesh(ball, folder.path() / ("whole" + extension)));
        if (!is_read(format)) continue;
        CHECK(io::names_mesh("ball" + extension));
        CHECK(io::read_mesh(folder.path() / ("whole" + extension))->triangles.size() == ball.triangles.size());
        if (format.has_signature == nullptr) continue;
        std::filesystem::copy_file(folder.path() / ("whole" + extension), folder.path() / "mesh.dat",
                                   std::filesystem::copy_options::overwrite_existing);
        CHECK(io::read_mesh(folder.path() / "mesh.dat").has_value());
    }
}

TEST_CASE("a volume is known by its name, and refused where a tree is needed") {
    const TemporaryFolder folder;
    for (const auto& format : io::volume_formats())
        for (const std::string_view extension : format.extensions) {
            CAPTURE(extension);
            const auto file = folder.path() / ("mask" + std::string(extension));
            CHECK(io::names_volume(file));
            std::ofstream(file) << "no volume";
            CHECK(io::read_tree(file).error().message().find("volume") != std::string::npos);
            Job job;
            const auto volume = io::read_volume(file, {}, job);
            REQUIRE_FALSE(volume);
            const std::string message = volume.error().message();
            CHECK(message.find(format.name) != std::string::npos);
        }
}

TEST_CASE("the documents list the formats in the order in which they are recognised") {
    const std::string formats = source_file("docs/FORMATS.md");
    std::size_t at = formats.find("## How a format is recognised");
    REQUIRE(at != std::string::npos);
    for (const io::FileFormat* format : io::recognition_order()) {
        CAPTURE(format->name);
        at = formats.find("| " + std::string(format->name) + " |", at);
        REQUIRE(at != std::string::npos);
    }
}

TEST_CASE("messages name the formats that there are") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "a.xyz") << "?";
    const auto message_of = [](const auto& result) { return result.error().message(); };
    const std::string tree = message_of(io::read_tree(folder.path() / "a.xyz"));
    const std::string written = message_of(io::check_tree_output(folder.path() / "b.xyz"));
    const std::string mesh = message_of(io::read_mesh(folder.path() / "a.xyz"));
    for (const auto extension : io::readable_extensions(io::tree_formats())) CHECK(tree.find(extension) != tree.npos);
    for (const auto extension : io::writable_extensions(io::tree_formats()))
        CHECK(written.find(extension) != written.npos);
    for (const auto extension : io::readable_extensions(io::mesh_formats())) CHECK(mesh.find(extension) != mesh.npos);
}

TEST_CASE("the manual page, the documents and the desktop's file types know every format") {
    const std::string manual = source_file("assets/desktop/ramus.1.in");
    const std::string formats = source_file("docs/FORMATS.md");
    const std::string types = source_file("assets/desktop/org.ramus.Ramus.xml");
    for_each_format([&](const io::FileFormat& format) {
        CAPTURE(format.name);
        // In the manual: .TP, the name, the help.
        CHECK(manual.find(".TP\n.B " + std::string(format.name) + "\n") != std::string::npos);
        CHECK(manual.find(format.help) != std::string::npos);
        for (const std::string_view extension : format.extensions) CHECK(manual.find(extension) != std::string::npos);
    });
    for (const auto& format : io::tree_formats()) {
        if (!is_read(format)) continue;
        for (const std::string_view extension : format.extensions) {
            CAPTURE(extension);
            CHECK(formats.find(extension) != std::string::npos);
            // Of .json the desktop knows already what it is; a session is .ramus.json. Tables and XML belong to others.
            if (extension == ".csv" || extension == ".xml") continue;
            CHECK(types.find("*" + std::string(extension == ".json" ? ".ramus.json" : extension)) != std::string::npos);
        }
    }
}
