#include "core/io/input_file.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/swc.h"

#include <algorithm>
#include <numeric>

namespace ramus::io {

namespace {

constexpr std::uint32_t kRoot = 0xFFFFFFFFU;
constexpr std::string_view kVoxel = " voxel";

// Nine numbers, and nothing else in their line.
void take_voxel(std::string_view text, ImportedTree& imported) {
    std::vector<std::string_view> words;
    split_words(text.substr(0, text.find_first_of("\r\n")), " ", words);
    glm::dmat3 edges(0.0);
    if (words.size() != 9) return;
    for (int n = 0; n < 9; ++n) {
        const std::optional<double> number = to_real(words[static_cast<std::size_t>(n)]);
        if (!number) return;
        edges[n / 3][n % 3] = *number;
    }
    imported.voxel = edges;
}

std::vector<std::uint32_t> parents_of(const tree::VesselTree& tree) {
    std::vector<std::uint32_t> parents(tree.points.size(), kRoot);
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i) parents[branch.points[i]] = branch.points[i - 1];
    return parents;
}

// Whether the present order of points preserves branch ids when the file is read. It needs parents before their
// children, and roots and the branches of a node in ascending order.
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

std::string claims_text(const tree::VesselTree& tree) {
    std::string text = "(" + std::string(tree.claims.unit_word()) + ", " + std::string(tree.claims.axes_word()) + ")";
    if (!tree.voxels || tree.voxels->estimated) return text;
    text += kVoxel;
    for (int edge = 0; edge < 3; ++edge)
        for (int axis = 0; axis < 3; ++axis) text += " " + exact_number(tree.voxels->edges_mm[edge][axis]);
    return text;
}

bool take_claims(std::string_view claims, ImportedTree& imported) {
    for (const std::string_view unit : {std::string_view("mm"), tree::kNotSaid})
        for (const std::string_view axes : {std::string_view("RAS"), tree::kNotSaid})
            if (claims.starts_with("(" + std::string(unit) + ", " + std::string(axes) + ")")) {
                imported.take_as_written(unit, axes);
                const std::string_view behind = claims.substr(claims.find(')') + 1);
                if (behind.starts_with(kVoxel)) take_voxel(behind.substr(kVoxel.size()), imported);
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
    output.write(std::string(kSwcColumns) + claims_text(tree) + "\n");
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
