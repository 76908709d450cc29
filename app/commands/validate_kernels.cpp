#include "app/commands/validate_kernels.h"

#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/session/numbers.h"
#include "core/validate/kernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;
using validate::KernelFigures;

ordered_json kernels_json(const validate::ComparedKernels& compared) {
    ordered_json list = ordered_json::array();
    for (const KernelFigures& one : compared.kernels) {
        ordered_json error{{"median", nullptr}, {"p95", nullptr}, {"places", one.radius_error.places}};
        if (one.radius_error.places > 0) error["median"] = one.radius_error.median, error["p95"] = one.radius_error.p95;
        list.push_back({{"kernel", std::string(field::row_of(one.kind).key)},
                        {"width", one.width > 0.0 ? ordered_json(one.width) : ordered_json(nullptr)},
                        {"support_radii", one.support_radii},
                        {"joints",
                         {{"merging", one.joints.merging},
                          {"parting", one.joints.parting},
                          {"blend_reach_radii", one.joints.blend_reach},
                          {"bulge_percent", one.joints.bulge_percent},
                          {"straight_percent", one.joints.straight_percent},
                          {"beyond_end_radii", one.joints.beyond_end}}},
                        {"radius_error", std::move(error)},
                        {"to_cones_mm", {{"mean", one.to_cones_mean_mm}, {"max", one.to_cones_max_mm}}},
                        {"merged", one.merged},
                        {"pieces", one.pieces},
                        {"loops", one.loops},
                        {"evaluations", one.evaluations},
                        {"triangles", one.triangles},
                        {"mesh_s", one.mesh_s}});
    }
    return {{"kernels", std::move(list)},
            {"graph", {{"pieces", compared.graph_pieces}, {"loops", compared.graph_loops}}}};
}

using Row = std::vector<std::string>;

// Formats a value that may be almost 0.
std::string thousandths(double value) { return rounded(std::round(1000.0 * value) / 1000.0 + 0.0); }

Row row_of_kernel(const KernelFigures& one) {
    const auto percent = [&](double share) { return one.radius_error.places > 0 ? digits(100.0 * share) : "-"; };
    return {std::string(field::row_of(one.kind).key),
            one.width > 0.0 ? digits(one.width) : "-",
            digits(one.joints.merging),
            digits(one.joints.parting),
            digits(one.joints.blend_reach),
            digits(one.joints.bulge_percent),
            thousandths(one.joints.straight_percent),
            thousandths(one.joints.beyond_end),
            percent(one.radius_error.median),
            percent(one.radius_error.p95),
            digits(one.to_cones_mean_mm),
            digits(one.to_cones_max_mm),
            grouped(one.merged),
            std::to_string(one.pieces) + " / " + std::to_string(one.loops),
            digits(static_cast<double>(one.evaluations) / 1e6),
            digits(one.mesh_s)};
}

// Aligns the first column to the left and all others to the right.
void print_table(const std::vector<Row>& rows) {
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const Row& row : rows)
        for (std::size_t n = 0; n < row.size(); ++n) widths[n] = std::max(widths[n], row[n].size());
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t n = 0; n < row.size(); ++n) {
            const std::string room(widths[n] - row[n].size(), ' ');
            line += n == 0 ? row[n] + room : "  " + room + row[n];
        }
        std::cout << line << '\n';
    }
}

void print_text(const validate::ComparedKernels& compared) {
    std::vector<Row> rows = {{"", "", "merge", "fork", "fork", "fork", "straight", "beyond", "radius", "error %",
                              "to cones", "mm", "", "", "", ""},
                             {"kernel", "width", "at", "parts", "reach", "bulge %", "off %", "end", "median", "p95",
                              "mean", "max", "merged", "pieces / loops", "Mevals", "mesh s"}};
    for (const KernelFigures& one : compared.kernels) rows.push_back(row_of_kernel(one));
    print_table(rows);
    std::cout
        << "\nThe tree has " << counted(static_cast<std::uint64_t>(compared.graph_pieces), "piece", "pieces") << " and "
        << counted(static_cast<std::uint64_t>(compared.graph_loops), "loop", "loops")
        << "; surfaces with --blend paper.\n"
           "merge at    two parallel vessels merge when their axes are closer than so many sums of their radii\n"
           "fork        of equal vessels, daughters 60 degrees apart. parts: radii from the crotch to their axes\n"
           "            (tubes: 1). reach: radii from the joint to where a daughter is 1 % thicker than its tube.\n"
           "            bulge: the most that the surface is outside of all tubes, in % of the radius\n"
           "straight    where two segments of a straight vessel meet: the most that the radius is off\n"
           "beyond end  radii that the surface goes on beyond a free end\n"
           "merged      vessels that pass each other without a joint, within the kernel's reach, and are one\n"
           "Mevals      millions of kernels evaluated, one for each segment and point\n";
}

} // namespace

Result<void> print_kernels(const std::string& name, const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                           bool json) {
    RAMUS_TRY(compared,
              with_progress("kernels", [&](Job& job) { return validate::compare_kernels(tree, options, job); }));
    if (json) {
        ordered_json all{{"tree", name}};
        all.update(kernels_json(compared));
        std::cout << printed_report(std::move(all), tree.claims) << '\n';
    } else {
        print_text(compared);
    }
    return {};
}

} // namespace ramus::app
