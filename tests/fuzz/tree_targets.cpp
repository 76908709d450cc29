// The readers of trees, by the table of formats: the tree that they make of the bytes, and the same tree through
// ramus's own format.
#include "core/io/inflate.h"
#include "core/io/trees/branch_table.h"
#include "core/io/trees/tree_file.h"
#include "core/io/vtk/vtk_blocks.h"
#include "tests/fuzz/target.h"

#include <array>
#include <filesystem>

namespace ramus::fuzz {

namespace {

// Half of all files, by their length, are read as people may ask for.
io::ReadOptions options_for(std::string_view bytes) {
    io::ReadOptions options;
    if (bytes.size() % 2 == 0) return options;
    options.repair = tree::Repair::kAll;
    options.unit = io::LengthUnit{{0.3, 0.3, 0.6}};
    options.radius_is = io::RadiusIs::kDiameter;
    options.orientation = io::Orientation::lps();
    if (bytes.size() % 4 == 1) options.radius_mm = 0.5;
    return options;
}

void check_own_format(const tree::VesselTree& tree) {
    const std::string path = written_file("again.json", {});
    std::filesystem::remove(path); // the one before was read, and would not be written over
    const auto written = io::write_tree(tree, path);
    must(written.has_value(), written ? "" : written.error().message());
    const auto read = io::read_tree(path);
    must(read.has_value(), "ramus does not read what it wrote: " + (read ? "" : read.error().message()));
    must(read->points == tree.points && read->roots == tree.roots && read->loop_count == tree.loop_count &&
             read->branches == tree.branches && read->labels == tree.labels && read->point_data == tree.point_data &&
             read->branch_data == tree.branch_data,
         "a tree is another one after ramus's own format");
}

void read_tree_bytes(std::string_view bytes, const std::string& name) {
    const auto tree = io::parse_tree(bytes, name, options_for(bytes));
    if (!tree) return check_error(tree.error(), name);
    check_tree(*tree);
    check_own_format(*tree);
}

// Nodes, and edges in a file beside them.
void read_pair(std::string_view bytes) {
    const auto [nodes, edges] = two_files(bytes);
    const std::string edges_file = written_file("tree_edges.csv", edges), file = written_file("tree_nodes.csv", nodes);
    const auto tree = io::read_tree(file, options_for(bytes));
    if (!tree) return check_error(tree.error(), file.substr(0, file.rfind('/')));
    check_tree(*tree);
    check_own_format(*tree);
}

// A table of further data for a tree of some branches.
void read_branch_table(std::string_view bytes) {
    constexpr std::size_t kBranches = 12;
    const auto table = io::parse_branch_table(bytes, "table.csv", kBranches);
    if (!table) return check_error(table.error(), "table.csv");
    must(!table->arrays.empty() && table->rows > 0, "a table without numbers was taken");
    for (const tree::DataArray& array : table->arrays)
        must(array.values.size() == kBranches, "an array has no value for each branch");
}

void inflate_bytes(std::string_view bytes) {
    constexpr std::uint64_t kMost = 1 << 20;
    const auto inflated = io::inflated(bytes, kMost, "a.gz");
    if (!inflated) return check_error(inflated.error(), "a.gz");
    must(inflated->size() <= kMost, "more was inflated than is allowed");
}

// The first byte chooses the compressor, two more are the size that the block claims, and the rest is the block.
void unpack_block(std::string_view bytes) {
    if (bytes.size() < 3) return;
    constexpr std::array kPackers{io::VtkCompressor::kZlib, io::VtkCompressor::kLz4, io::VtkCompressor::kLzma};
    const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at])); };
    const io::VtkCompressor packer = kPackers[byte(0) % kPackers.size()];
    const std::size_t size = byte(1) + 256 * byte(2);
    const std::string_view packed = bytes.substr(3);
    if (!can_grow_to(packer, packed.size(), size)) return;
    const auto plain = unpacked_block(packer, packed, size);
    must(!plain || plain->size() == size, "a block is not as long as it was said to be");
}

} // namespace

std::vector<Target> tree_targets() {
    std::vector<Target> targets{
        {"gz", inflate_bytes}, {"vtk-blocks", unpack_block}, {"branch-table", read_branch_table}};
    for (const io::TreeFormat& format : io::tree_formats()) {
        if (!io::is_read(format)) continue;
        const std::string extension(format.extensions.front());
        if (extension == ".csv")
            targets.push_back({"csv", read_pair});
        else
            targets.push_back({extension.substr(1),
                               [name = "tree" + extension](std::string_view bytes) { read_tree_bytes(bytes, name); }});
    }
    return targets;
}

} // namespace ramus::fuzz
