#include "core/mesh/check_kernel.h"

#include "core/field/kernel.h"
#include "core/mesh/tree_field.h"

#include <string>

namespace ramus::mesh {

Result<void> check_kernel(const SurfaceOptions& options) {
    if (options.method != Method::kConvolutionSurface) return {};
    if (auto takes = field::check_width(options.kernel, options.width); !takes) return takes;
    if (options.kernel == field::KernelKind::kGaussian || !row_of(options.blend).separates) return {};
    if (kernel_of(options).limits.merged <= kMostKeptApart) return {};
    const field::KernelRow& row = field::row_of(options.kernel);
    return fail("the kernel " + std::string(row.key) + (row.most_width > 0.0 ? " of this width" : "") +
                    " blends too far for vessels that only press on each other to be kept apart",
                {}, row.most_width > 0.0 ? "give --blend paper, or a larger --width" : "give --blend paper");
}

} // namespace ramus::mesh
