#include "app/assets/lesion_text.h"

#include "app/session/systems.h"

namespace ramus::app {

std::string vessels_name(const tree::VesselTree& tree, const Marks& marks, const measure::LesionVessels& vessels) {
    return tree.systems.size() < 2 ? "vessels" : system_name(systems_of(tree, marks), vessels.system);
}

std::string distance_text(const measure::NearestWall& nearest, const Lengths& lengths) {
    if (nearest.distance_mm > 0.0) return lengths.text(nearest.distance_mm);
    const std::string none = "0 " + lengths.unit();
    return nearest.overlap_mm > 0.0 ? none + ", overlap " + lengths.text(nearest.overlap_mm) : none;
}

std::string contact_text(const measure::LesionVessels& vessels, const Lengths& lengths) {
    if (vessels.touched == 0) return "no contact";
    std::string text =
        "contact " + digits(vessels.contact.angle_deg) + "\xC2\xB0 over " + lengths.text(vessels.contact.length_mm);
    if (vessels.touched > 1)
        text += "; " + counted(static_cast<std::uint64_t>(vessels.touched), "branch", "branches") + " over " +
                lengths.text(vessels.touched_mm);
    return text;
}

std::string size_text(const LesionMesh& mesh, const Lengths& lengths) {
    const Lengths own = mesh.volume_mm3 ? Lengths(mesh.claims) : lengths;
    const std::string diameter = "\xC3\x98 " + own.text(mesh.diameter_mm);
    return mesh.volume_mm3 ? diameter + ", " + own.volume(*mesh.volume_mm3) : diameter;
}

} // namespace ramus::app
