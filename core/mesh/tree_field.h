// From a vessel tree to the field whose isosurface is its surface: the tree as prepared, the field of all branches, and
// the fields of what is visible. Every surface is made of these, once (surface.h) or following what is hidden
// (followed_surface.h).
//
// Which field it is says a row of kBlends (blend.h): another field is a model of core/field/field.h, and a row there.
#pragma once

#include "core/base/error.h"
#include "core/field/field.h"
#include "core/mesh/surface_options.h"
#include "core/tree/contacts/contacts.h"
#include "core/tree/prepare.h"

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

// What is left of a prepared tree without the hidden branches (by id in its source, not 0: hidden). It may have fewer
// branches.
[[nodiscard]] PreparedTree visible_part(PreparedTree prepared, std::span<const std::uint8_t> hidden);

[[nodiscard]] field::Kernel kernel_of(const SurfaceOptions& options);

// What a row of kBlends makes its field of.
struct FieldParts {
    const PreparedTree& tree;
    const field::ConvolutionField& sum;             // of the kernel over all segments of the tree
    std::shared_ptr<const tree::Contacts> contacts; // of the tree; without any where the row does not separate vessels
    field::Rims rims;
};

struct TreeField {
    PreparedTree tree;
    field::Field field; // of all branches
};

// Looks at the plain sum before contacts are searched, which takes longer the thicker vessels are.
using SumCheck = std::function<Result<void>(const field::Field& sum)>;

// The frame of the field is that of the whole tree, so that hiding and pruning leave everything else as it is, to the
// last bit. Fails as `check` does.
[[nodiscard]] Result<TreeField> make_tree_field(const tree::VesselTree& source, const SurfaceOptions& options,
                                                const SumCheck& check = {});
// Its field, without the hidden branches (by id in `source`, not 0: hidden).
[[nodiscard]] field::Field make_field(const tree::VesselTree& source, const SurfaceOptions& options,
                                      std::span<const std::uint8_t> hidden);

// The field of one vessel system, which has a surface of its own (systems.h), or of a whole tree with no more than one.
struct SystemField {
    field::Field field;
    std::vector<std::uint8_t> hidden; // by branch id, not 0: hidden, or of another system; empty: none
    [[nodiscard]] bool visible() const { return !field.skeleton().present().empty(); }
};

// The fields of all systems, in their order, the hidden ones too.
[[nodiscard]] std::vector<SystemField> fields_by_system(const tree::VesselTree& source, const field::Field& whole,
                                                        std::span<const std::uint8_t> hidden);

} // namespace ramus::mesh
