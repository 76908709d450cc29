#include "core/io/output_file.h"
#include "core/io/trees/swc.h"
#include "core/io/trees/vmv.h"

namespace ramus::io {

Result<void> write_vmv(const tree::VesselTree& tree, const std::filesystem::path& file,
                       const std::vector<std::string>& comments) {
    RAMUS_TRY(output, OutputFile::create(file));
    write_comments(output, comments);
    output.write(std::string(kVmvColumns) + claims_text(tree) + "\n" + std::string(kVmvRoots));
    for (const std::uint32_t root : tree.roots) output.write(" " + std::to_string(root + 1));
    output.write("\n\n$PARAM_BEGIN\nNUM_VERTS\t" + std::to_string(tree.points.size()) + "\nNUM_STRANDS\t" +
                 std::to_string(tree.branches.size()) + "\nNUM_ATTRIB_PER_VERT\t4\n$PARAM_END\n\n$VERT_LIST_BEGIN\n");
    for (std::size_t p = 0; p < tree.points.size(); ++p) {
        const tree::Point& at = tree.points[p];
        output.write_number(p + 1);
        for (const double value : {at.position.x, at.position.y, at.position.z, at.radius}) {
            output.write("\t");
            output.write_number(value);
        }
        output.write("\n");
    }
    output.write("$VERT_LIST_END\n\n$STRANDS_LIST_BEGIN\n");
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        output.write_number(b + 1);
        for (const std::uint32_t point : tree.branches[b].points) {
            output.write("\t");
            output.write_number(point + 1);
        }
        output.write("\n");
    }
    output.write("$STRANDS_LIST_END\n");
    return output.commit();
}

} // namespace ramus::io
