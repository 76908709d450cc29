#include "app/reports/page/page_blob.h"

#include "core/io/binary_numbers.h"

#include <nlohmann/json.hpp>

namespace ramus::app {

std::size_t PageBlob::add(std::string_view compressed) {
    buffers_.emplace_back(text_.size() / 4 * 3, compressed.size());
    text_ += io::base64_encoded(compressed); // padded, so that the next one begins at whole groups
    return buffers_.size() - 1;
}

nlohmann::ordered_json PageBlob::add(const PackedMesh& mesh) {
    nlohmann::ordered_json entry = {{"origin", {mesh.origin.x, mesh.origin.y, mesh.origin.z}},
                                    {"step", mesh.step_mm},
                                    {"vertices", mesh.vertices},
                                    {"triangles", mesh.triangles},
                                    {"counts", add(mesh.counts)},
                                    {"shifts", add(mesh.shifts)},
                                    {"gates", add(mesh.gates)},
                                    {"extras", add(mesh.extras)},
                                    {"corrections", add(mesh.corrections)}};
    if (mesh.coarse_triangles > 0)
        entry["coarse"] = {{"triangles", mesh.coarse_triangles},
                           {"counts", add(mesh.coarse_counts)},
                           {"gates", add(mesh.coarse_gates)},
                           {"extras", add(mesh.coarse_extras)}};
    return entry;
}

nlohmann::ordered_json PageBlob::table() const {
    nlohmann::ordered_json table = nlohmann::ordered_json::array();
    for (const auto& [start, bytes] : buffers_) table.push_back({start, bytes});
    return table;
}

} // namespace ramus::app
