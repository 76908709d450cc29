#include "core/mesh/untangle/places_apart.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::mesh {

namespace {

constexpr double kAroundTube = 1.5; // radii around an axis, that a vessel's surface lies within beside another vessel

// By piece of vessel: around its tube.
std::vector<TriangleBox> boxes_of_pieces(const tree::PreparedTree& prepared, const tree::Contacts& contacts) {
    std::vector<TriangleBox> boxes(contacts.first_partner.size() - 1);
    std::size_t segment = 0;
    for (const tree::Branch& branch : prepared.tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n, ++segment) {
            const std::size_t index = prepared.segment_index.empty() ? segment : prepared.segment_index[segment];
            TriangleBox& box = boxes[contacts.piece_of_segment[index]];
            for (const std::size_t end : {n - 1, n}) {
                const tree::Point& point = prepared.tree.points[branch.points[end]];
                box.hold(glm::vec3(point.position), static_cast<float>(kAroundTube * point.radius));
            }
        }
    return boxes;
}

} // namespace

std::vector<TriangleBox> places_apart(const tree::PreparedTree& prepared, const tree::Contacts& contacts) {
    if (contacts.empty()) return {};
    const std::vector<TriangleBox> boxes = boxes_of_pieces(prepared, contacts);
    std::vector<TriangleBox> places;
    for (std::uint32_t piece = 0; piece < boxes.size(); ++piece) {
        TriangleBox place;
        for (const tree::Contacts::Partner& partner : contacts.partners_of(piece)) {
            const TriangleBox common = boxes[piece].common(boxes[partner.piece]);
            if (partner.piece > piece && glm::all(glm::lessThanEqual(common.least, common.most))) place.hold(common);
        }
        if (place.least.x <= place.most.x) places.push_back(place);
    }
    return places;
}

} // namespace ramus::mesh
