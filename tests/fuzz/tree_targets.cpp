// The readers of trees, by the table of formats: the tree that they make of the bytes, and the same tree through
// ramus's own format.
#include "core/io/inflate.h"
#include "core/io/trees/tree_file.h"
#include "tests/fuzz/target.h"

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
             read->branches == tree.branches && read->labels == tree.labels,
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

void inflate_bytes(std::string_view bytes) {
    constexpr std::uint64_t kMost = 1 << 20;
    const auto inflated = io::inflated(bytes, kMost, "a.gz");
    if (!inflated) return check_error(inflated.error(), "a.gz");
    must(inflated->size() <= kMost, "more was inflated than is allowed");
}

} // namespace

std::vector<Target> tree_targets() {
    std::vector<Target> targets{{"gz", inflate_bytes}};
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
