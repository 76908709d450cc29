#include "core/io/output_file.h"
#include "core/io/trees/swc.h"

#include <algorithm>
#include <numeric>

namespace ramus::io {

namespace {

constexpr std::uint32_t kRoot = 0xFFFFFFFFU;

std::vector<std::uint32_t> parents_of(const tree::VesselTree& tree) {
    std::vector<std::uint32_t> parents(tree.points.size(), kRoot);
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i) parents[branch.points[i]] = branch.points[i - 1];
    return parents;
}

// Would a reader that takes points as they stand find the same branches under the same ids? It needs parents before
// their children, and roots and the branches of a node in ascending order.
bool order_keeps_ids(const tree::VesselTree& tree, const std::vector<std::uint32_t>& parents) {
    if (!std::ranges::is_sorted(tree.roots)) return false;
    for (std::uint32_t p = 0; p < parents.size(); ++p)
        if (parents[p] != kRoot && parents[p] >= p) return false;
    std::vector<std::uint32_t> latest(tree.points.size(), 0);
    for (const tree::Branch& branch : tree.branches) {
        std::uint32_t& before = latest[branch.points.front()];
        if (branch.points[1] < before) return false;
        before = branch.points[1];
    }
    return true;
}

// Points in the order of the file.
std::vector<std::uint32_t> order_of(const tree::VesselTree& tree, const std::vector<std::uint32_t>& parents) {
    std::vector<std::uint32_t> order(tree.points.size());
    std::iota(order.begin(), order.end(), 0U);
    if (order_keeps_ids(tree, parents)) return order;
    order.clear();
    std::vector<bool> placed(tree.points.size(), false);
    for (const tree::Branch& branch : tree.branches) {
        for (const std::uint32_t point : branch.points) {
            if (!placed[point]) order.push_back(point);
            placed[point] = true;
        }
    }
    return order;
}

} // namespace

std::string claims_text(const tree::Claims& claims) {
    return "(" + std::string(claims.unit_word()) + ", " + std::string(claims.axes_word()) + ")";
}

bool take_claims(std::string_view claims, ImportedTree& imported) {
    for (const std::string_view unit : {std::string_view("mm"), tree::kNotSaid})
        for (const std::string_view axes : {std::string_view("RAS"), tree::kNotSaid})
            if (claims.starts_with("(" + std::string(unit) + ", " + std::string(axes) + ")")) {
                imported.take_as_written(unit, axes);
                return true;
            }
    return false;
}

void write_comments(BufferedFile& file, const std::vector<std::string>& comments) {
    for (std::string comment : comments) {
        std::ranges::replace_if(
            comment, [](char c) { return c == '\n' || c == '\r' || c == '\0'; }, ' ');
        file.write("# " + comment + "\n");
    }
}

Result<void> write_swc(const tree::VesselTree& tree, const std::filesystem::path& file,
                       const std::vector<std::string>& comments) {
    if (tree.loop_count > 0)
        return fail("SWC cannot hold the " + std::to_string(tree.loop_count) +
                        (tree.loop_count == 1 ? " loop" : " loops") + " of this network",
                    file.string(), "write ramus's own .json instead");
    const std::vector<std::uint32_t> parents = parents_of(tree);
    const std::vector<std::uint32_t> order = order_of(tree, parents);
    std::vector<std::uint32_t> id(tree.points.size(), 0);
    for (std::uint32_t i = 0; i < order.size(); ++i) id[order[i]] = i + 1;

    RAMUS_TRY(output, OutputFile::create(file));
    write_comments(output, comments);
    output.write(std::string(kSwcColumns) + claims_text(tree.claims) + "\n");
    for (const std::uint32_t point : order) {
        const tree::Point& at = tree.points[point];
        output.write_number(id[point]);
        output.write(" ");
        output.write_number(tree.labels.empty() ? 0 : tree.labels[point]);
        for (const double value : {at.position.x, at.position.y, at.position.z, at.radius}) {
            output.write(" ");
            output.write_number(value);
        }
        output.write(" ");
        output.write_number(parents[point] == kRoot ? std::int64_t{-1} : std::int64_t{id[parents[point]]});
        output.write("\n");
    }
    return output.commit();
}

} // namespace ramus::io
