#include "core/mesh/tree_field.h"

#include "core/field/kernel.h"
#include "core/field/kernel_radii.h"
#include "core/field/vessel_field.h"
#include "core/mesh/systems.h"
#include "core/tree/curves.h"
#include "core/tree/smooth.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace ramus::mesh {

PreparedTree prepare_tree(const tree::VesselTree& source, const SurfaceOptions& options) {
    PreparedTree prepared = tree::prune(source, options.prune_ratio);
    prepared.tree = tree::smooth(std::move(prepared.tree), options.smooth_passes);
    // Truncated cones are the paper's: one for each segment.
    if (options.centerline == tree::Centerline::kLines || options.method == Method::kTruncatedCones) return prepared;
    // Numbers of pieces stay what they are, whatever is pruned.
    const std::vector<tree::CurvePieces> pieces = tree::pieces_of_curves(
        prepared.segment_index.empty() ? prepared.tree : tree::smooth(source, options.smooth_passes));
    return tree::along_curves(std::move(prepared), pieces);
}

PreparedTree visible_part(PreparedTree prepared, std::span<const std::uint8_t> hidden) {
    const auto is_hidden = [&](int branch) {
        const auto index = static_cast<std::size_t>(branch);
        return index < hidden.size() && hidden[index] != 0;
    };
    if (std::ranges::none_of(hidden, [](std::uint8_t h) { return h != 0; })) return prepared;
    std::vector<int> kept_source;
    std::vector<tree::Branch> kept;
    std::size_t ordinal = 0;
    for (const tree::Branch& branch : prepared.tree.branches) {
        // Pruning joins branches of the file into one: the run is cut where hidden ones begin and end.
        tree::Branch run;
        for (std::size_t i = 1; i < branch.points.size(); ++i, ++ordinal) {
            if (is_hidden(prepared.segment_source[ordinal])) {
                if (run.points.size() > 1) kept.push_back(run);
                run.points.clear();
                continue;
            }
            if (run.points.empty()) run.points.push_back(branch.points[i - 1]);
            run.points.push_back(branch.points[i]);
            kept_source.push_back(prepared.segment_source[ordinal]);
        }
        if (run.points.size() > 1) kept.push_back(run);
    }
    prepared.tree.branches = std::move(kept);
    prepared.segment_source = std::move(kept_source);
    return prepared;
}

namespace {

// Of all trees that pruning may leave. Pruning may take the thinnest vessel, or the one that reaches farthest; bounds
// of the tree as it came hold what smoothing makes of any part of it.
field::Extent extent_of_all_parts(const tree::VesselTree& source, SurfaceOptions options, double support_radii) {
    const auto extent_of = [&](int smooth_passes) {
        options.smooth_passes = smooth_passes;
        return field::Skeleton(prepare_tree(source, options), support_radii).extent();
    };
    options.prune_ratio = 0.0;
    const double thinnest = extent_of(options.smooth_passes).thinnest;
    options.centerline = tree::Centerline::kLines; // curves stay within the hull of their points
    field::Extent extent = extent_of(0);
    extent.thinnest = thinnest;
    return extent;
}

field::ConvolutionField sum_of(const tree::VesselTree& source, const SurfaceOptions& options,
                               const PreparedTree& prepared) {
    const field::Kernel kernel = kernel_of(options);
    const bool exact = options.radii == Radii::kExact;
    if (!(options.prune_ratio > 0.0)) return {field::Skeleton(prepared, kernel.support_radii), kernel};
    field::Extent extent = extent_of_all_parts(source, options, kernel.support_radii * (exact ? field::kWidest : 1.0));
    if (exact) extent.thinnest *= field::kNarrowest;
    return {field::Skeleton(prepared, kernel.support_radii, extent), kernel};
}

} // namespace

field::Kernel kernel_of(const SurfaceOptions& options) { return field::make_kernel(options.kernel, options.width); }

field::Field plain_field(const FieldParts& parts) { return parts.sum; }

field::Field separated_field(const FieldParts& parts) {
    if (parts.contacts->empty()) return parts.sum;
    return field::VesselField(parts.sum, parts.contacts, parts.rims);
}

Result<TreeField> make_tree_field(const tree::VesselTree& source, const SurfaceOptions& options,
                                  const SumCheck& check) {
    const field::Kernel kernel = kernel_of(options);
    PreparedTree prepared = prepare_tree(source, options);
    if (options.radii == Radii::kExact) prepared = field::with_kernel_radii(std::move(prepared), kernel);
    std::optional<field::ConvolutionField> sum = sum_of(source, options, prepared);
    LargeAllocator<std::byte> memory;
    if (check) {
        RAMUS_TRY(chosen, check(*sum));
        memory = std::move(chosen);
    }
    const BlendRow& row = row_of(options.blend);
    auto contacts = std::make_shared<tree::Contacts>();
    if (row.separates) {
        // The search takes as much memory as the segments, which are quickly made again.
        const field::Extent extent = sum->extent();
        sum.reset();
        *contacts = tree::find_contacts(prepared, kernel.limits, memory);
        sum.emplace(field::Skeleton(prepared, kernel.support_radii, extent), kernel);
    }
    prepared.kernel_radii = {};
    field::Field field = row.make({prepared, *sum, std::move(contacts), options.rims});
    return TreeField{std::move(prepared), std::move(field)};
}

std::vector<SystemField> fields_by_system(const tree::VesselTree& source, const field::Field& whole,
                                          std::span<const std::uint8_t> hidden) {
    std::vector<SystemField> fields;
    if (source.systems.size() < 2) {
        fields.push_back({hidden.empty() ? whole : whole.without(hidden), {hidden.begin(), hidden.end()}});
        return fields;
    }
    for (int system = 0; system < static_cast<int>(source.systems.size()); ++system) {
        std::vector<std::uint8_t> others = hidden_beside(source, system, hidden);
        fields.push_back({whole.without(others), std::move(others)});
    }
    return fields;
}

} // namespace ramus::mesh
