#include "app/commands/part_of_surface.h"

#include "app/commands/command.h"
#include "app/commands/output_target.h"
#include "app/commands/printed_report.h"
#include "app/commands/printing.h"
#include "app/session/numbers.h"

#include <charconv>
#include <string_view>

namespace ramus::app {

namespace {

constexpr std::size_t kMostParts = 100'000;

// "3/16": the third of 16 parts.
std::optional<mesh::PartOf> part_named(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    const auto number = [](std::string_view digits) -> std::size_t {
        std::size_t value = 0;
        const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return code == std::errc() && end == digits.data() + digits.size() ? value : 0;
    };
    const std::size_t index = number(text.substr(0, slash)), count = number(text.substr(slash + 1));
    if (index < 1 || index > count || count > kMostParts) return std::nullopt;
    return mesh::PartOf{index - 1, count};
}

} // namespace

void add_part_flag(CLI::App& command, std::optional<mesh::PartOf>& part) {
    add_option_taking<std::string>(
        command, "--part", "I/N", [&part](const std::string& text) { part = part_named(text); },
        "Only the Ith of N parts with about equal work, with an open border and without repairs; ramus-mpi makes all "
        "parts at once, and repairs the whole")
        ->check(expecting(" is not a part like 1/4 to 4/4", part_named));
}

void check_divided(const CLI::App& command, const std::filesystem::path& output, bool is_mask) {
    if (is_mask) throw CLI::ValidationError("--method", "iso makes no surface in parts");
    if (command.get_option("--for-printing")->count() > 0)
        throw CLI::ValidationError("--for-printing", "is not for a surface that is made in parts");
    if (is_standard_output(output)) throw CLI::ValidationError("--output", "must be a file");
}

std::string part_report(const WrittenSurface& written, const mesh::PartOf& part, const std::filesystem::path& output,
                        double load_s, bool json) {
    const mesh::PartStatistics& made = written.part;
    if (!json)
        return output_name(output) + ": part " + std::to_string(part.index + 1) + " of " + std::to_string(part.count) +
               ", " + counted(written.triangles, "triangle", "triangles") + ", " +
               counted(written.vertices, "vertex", "vertices") + " in " +
               rounded(load_s + written.mesh_s + written.write_s) + " s; nothing of it is repaired";
    // Evaluations at the border are those that another part makes, too.
    return printed_report({{"vertices", written.vertices},
                           {"triangles", written.triangles},
                           {"streamed", written.streamed},
                           {"evaluations", written.evaluations},
                           {"part",
                            {{"index", part.index + 1},
                             {"count", part.count},
                             {"share", made.share},
                             {"border_evaluations", made.border_evaluations},
                             {"octree_s", made.bricks_s},
                             {"find_s", made.find_s},
                             {"cells_s", made.cells_s},
                             {"join_s", made.join_s}}},
                           {"load_s", load_s},
                           {"mesh_s", written.mesh_s},
                           {"write_s", written.write_s}});
}

} // namespace ramus::app
