// From a vessel tree to the scalar field whose isosurface is the tree's surface. make_tree_field() prepares the tree
// (prunes, smooths, rounds corners) and computes its field; surface.h polygonizes that field once, followed_surface.h
// whenever branches are hidden or shown. Lengths are in mm.
//
// The option `blend` selects the field: each row of kBlends (blend.h) names the function that makes it. To add a field,
// write a model of core/field/field.h and a row.
#pragma once

#include "core/base/error.h"
#include "core/base/large_array.h"
#include "core/field/field.h"
#include "core/mesh/surface_options.h"
#include "core/tree/contacts/contacts.h"
#include "core/tree/prepare.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace ramus::field {
class ConvolutionField;
} // namespace ramus::field

namespace ramus::mesh {

using tree::PreparedTree;

// The tree as the surface sees it: pruned first, then smoothed.
[[nodiscard]] PreparedTree prepare_tree(const tree::VesselTree& source, const SurfaceOptions& options);

// The prepared tree without the hidden branches (by id in its source, not 0: hidden).
[[nodiscard]] PreparedTree visible_part(PreparedTree prepared, std::span<const std::uint8_t> hidden);

[[nodiscard]] field::Kernel kernel_of(const SurfaceOptions& options);

// The input of the function of a row of kBlends.
struct FieldParts {
    const PreparedTree& tree;
    const field::ConvolutionField& sum;             // the sum of the kernel over all segments of the tree
    std::shared_ptr<const tree::Contacts> contacts; // empty if the row does not separate vessels
    field::Rims rims;
};

struct TreeField {
    PreparedTree tree;
    field::Field field; // of all branches
};

// Checks the plain sum before contacts are searched: the search takes the longer, the thicker the vessels are. Returns
// the memory for that search.
using SumCheck = std::function<Result<LargeAllocator<std::byte>>(const field::Field& sum)>;

// The extent of the field is that of the whole tree, so that hiding and pruning leave everything else as it is, to the
// last bit. Fails as `check` does.
[[nodiscard]] Result<TreeField> make_tree_field(const tree::VesselTree& source, const SurfaceOptions& options,
                                                const SumCheck& check = {});

// The field of one vessel system, which has a surface of its own (systems.h), or of a whole tree with no more than one.
struct SystemField {
    field::Field field;
    std::vector<std::uint8_t> hidden; // by branch id, not 0: hidden, or of another system; empty: none
    [[nodiscard]] bool visible() const { return !field.skeleton().present().empty(); }
};

// The fields of all systems for a surface that follows them, in their order, the hidden ones too. Once:
// hidden_by_system() (systems.h).
[[nodiscard]] std::vector<SystemField> fields_by_system(const tree::VesselTree& source, const field::Field& whole,
                                                        std::span<const std::uint8_t> hidden);

} // namespace ramus::mesh
