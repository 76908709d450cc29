// VesselCones: places the fitted cones in eye space for every picture, and finds which of them are near glass.
#pragma once

#include "render/caster/cast_types.h"
#include "render/caster/fitted_cones.h"
#include "render/scene/frame.h"
#include "render/scene/layer.h"
#include "render/scene/look_data.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

namespace ramus::render::caster {

// The cones to cast in one picture.
struct ConeList {
    enum class Kind : std::uint8_t { kNone, kOpaque, kGlass }; // kNone: invisible

    std::vector<RoundCone> cones;
    std::vector<Kind> kinds; // by cone
};

// Appends the spheres of lesions as glass.
void append_lesions(const View& view, const LookData& data, ConeList& list);

class VesselCones {
public:
    // Adopts the frame's cones if they belong to its lines; otherwise uses `known` if those do; otherwise builds them.
    // `known`: built elsewhere, for another picture; may be null.
    void follow(const Frame& frame, const std::shared_ptr<const FittedCones>& known);
    [[nodiscard]] const std::shared_ptr<const FittedCones>& fitted() const { return fitted_; } // of the last picture

    // Fills the list with cones for opaque vessels, for glass, and for the lines inside glass. `layers`: by branch;
    // `to_eye`: from mm to eye space. Returns the number of visible vessel cones. Also updates field().
    std::size_t prepare(const Frame& frame, const View& view, const glm::dmat4& to_eye,
                        const std::vector<Layer>& layers, ConeList& list);
    [[nodiscard]] const Field& field() const { return field_; }

private:
    using Segment = FittedCones::Segment;
    // Transforms of one picture.
    struct Placement {
        const Frame& frame;
        const View& view;
        glm::mat4 to_eye;
    };
    void find_mixed_layers(const std::vector<Layer>& layers); // cached until a branch changes its layer
    // A range of segments of one branch.
    struct Run {
        std::size_t first, count;
    };
    // Returns false if the run is invisible. Takes the run's ends from `points`.
    [[nodiscard]] bool prepare(const Run& run, const Placement& placement, const std::vector<glm::vec4>& points,
                               RoundCone& cone) const;
    [[nodiscard]] bool prepare_line(const Run& run, const Placement& placement, RoundCone& cone) const;
    // Whether one cone from end to end looks like the cones of the run's segments.
    [[nodiscard]] bool is_straight(const Run& run, const Placement& placement) const;
    // Appends as few cones as represent the run faithfully, each in the place of its first segment. Returns how many
    // are visible.
    std::size_t prepare_run(const Run& run, const Placement& placement, ConeList& list) const;

    std::shared_ptr<const FittedCones> fitted_;
    std::vector<Layer> layers_, segment_layers_; // by branch; by segment
    Neighbours other_layer_;                     // the neighbours that belong to another layer
    std::vector<FieldSegment> field_segments_;   // empty: the cones are the surface
    Field field_{};
};

} // namespace ramus::render::caster
