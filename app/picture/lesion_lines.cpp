#include "app/picture/lesion_lines.h"

#include "app/assets/lesion_text.h"
#include "app/picture/colouring.h"
#include "app/picture/place_marks.h"

namespace ramus::app {

void draw_shortest_distances(render::Frame& frame, const Plan& plan, const Marks& marks, const PointedLesion& pointed,
                             const tree::Claims& claims) {
    constexpr glm::vec3 kLine{1.00F, 0.93F, 0.60F}, kPointed{1.00F, 0.99F, 0.90F};
    for (const measure::LesionVessels& vessels : plan.vessels) {
        const bool at = static_cast<int>(vessels.lesion) == pointed.lesion &&
                        (pointed.system < 0 || pointed.system == vessels.system);
        const measure::NearestWall& nearest = vessels.nearest;
        if (nearest.branch == tree::kNoBranch || !(at || marks.shortest_distances)) continue;
        if (!at && state_of(marks, nearest.branch) == tree::BranchState::kHidden) continue;
        const glm::vec3 colour = at ? kPointed : kLine;
        frame.lines.push_back({{nearest.on_lesion, nearest.on_wall}, colour, at ? 3.0F : 2.0F});
        for (const glm::dvec3& end : {nearest.on_lesion, nearest.on_wall})
            frame.lines.push_back(dot_at(frame, end, colour));
        const Lengths lengths(claims);
        frame.labels.push_back({0.5 * (nearest.on_lesion + nearest.on_wall),
                                latin1(nearest.overlap_mm > 0.0 ? "overlap " + lengths.text(nearest.overlap_mm)
                                                                : distance_text(nearest, lengths))});
    }
}

} // namespace ramus::app
