// Round cones of vessels before the eye, for every picture, and which of them have glass beside what is opaque.
#pragma once

#include "render/caster/cast_types.h"
#include "render/caster/fitted_cones.h"
#include "render/scene/frame.h"
#include "render/scene/layer.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

namespace ramus::render::caster {

// What is cast in a picture.
struct ConeList {
    enum class Kind : std::uint8_t { kNone, kOpaque, kGlass }; // kNone: there is nothing of it to see

    std::vector<RoundCone> cones;
    std::vector<Kind> kinds; // of them
};

// Appends balls of lesions, as glass: centre in eye space, radius.
void append_lesions(const View& view, const std::vector<glm::vec4>& spheres, ConeList& list);

class VesselCones {
public:
    // Takes those that the frame brings along, if they are of its lines; makes them where it has none. `known`: made
    // elsewhere, for another picture; may be null.
    void follow(const Frame& frame, const std::shared_ptr<const FittedCones>& known);
    [[nodiscard]] const std::shared_ptr<const FittedCones>& fitted() const { return fitted_; } // of the last picture

    // Fills the list with cones for opaque vessels, for glass and for the lines inside it. `layers`: of branches;
    // `to_eye`: from mm to eye space. Returns how many vessels' cones can be seen. field() is of the same picture.
    std::size_t prepare(const Frame& frame, const View& view, const glm::dmat4& to_eye,
                        const std::vector<Layer>& layers, ConeList& list);
    [[nodiscard]] const Field& field() const { return field_; }

private:
    using Segment = FittedCones::Segment;
    // Where a picture has the segments.
    struct Placement {
        const Frame& frame;
        const View& view;
        glm::mat4 to_eye;
    };
    void find_mixed_layers(const std::vector<Layer>& layers); // lasts until what is in glass changes
    // Segments of one branch, the first and how many.
    struct Run {
        std::size_t first, count;
    };
    // False: there is nothing of it to see. The ends are those of `points` that the run joins.
    [[nodiscard]] bool prepare(const Run& run, const Placement& placement, const std::vector<glm::vec4>& points,
                               RoundCone& cone) const;
    [[nodiscard]] bool prepare_line(const Run& run, const Placement& placement, RoundCone& cone) const;
    // Whether one cone, from end to end, looks as those of its segments do.
    [[nodiscard]] bool is_straight(const Run& run, const Placement& placement) const;
    // Cones of the run, as few as look like it: each in the place of its first segment. Returns how many are seen.
    std::size_t prepare_run(const Run& run, const Placement& placement, ConeList& list) const;

    std::shared_ptr<const FittedCones> fitted_;
    std::vector<Layer> layers_, segment_layers_; // by branch; by segment
    Neighbours other_layer_;                     // of the neighbours those of another layer
    std::vector<FieldSegment> field_segments_;   // none: the surface is cones
    Field field_{};
};

} // namespace ramus::render::caster
