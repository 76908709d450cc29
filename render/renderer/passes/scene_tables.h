// SceneTables: what shade.frag knows of lesions, margins, scales, cuts and context: a uniform block and small textures.
// What a plain tree does not need costs it nothing.
#pragma once

#include "render/renderer/scene_on_card.h"

namespace ramus::render {

class SceneTables {
public:
    void make();
    void let_go(); // of all but the block
    // What the shading of this frame has to do beside a plain tree's.
    struct Needs {
        bool margins = false, scale = false, context = false;
    };
    // Sends and binds all of it.
    Needs send(const Subject& subject);

private:
    void send_margins(const Frame& frame, const glm::dmat4& eye, SceneBlock& block);
    void send_distances(const DistanceGrid& grid, const glm::dmat4& from_eye, SceneBlock& block);
    void send_scale(const ColourScale& scale, SceneBlock& block);
    void send_cuts(const Frame& frame, const Centerlines& lines, const glm::dmat4& eye, SceneBlock& block);

    Buffer block_;
    TexelTable lesions_{GL_RGBA32F}, cuts_{GL_RGBA32F}, context_{GL_RGBA32F};
    Texture ramp_;                              // RGB16F, 8 bytes a colour
    Texture distances_;                         // R32F, 4 bytes a sample
    std::shared_ptr<const DistanceGrid> shown_; // in distances_
};

// Linear, with the opacity; negative: lines.
[[nodiscard]] std::vector<glm::vec4> context_colours(const Frame& frame);

// Where parts of branches that are lost begin and end, as behind_cut() of scene.glsl reads it: five texels a part, in
// eye space. The branch and which ends it has, then for each end its position and its direction.
[[nodiscard]] std::vector<glm::vec4> cut_ends(const std::vector<LostPart>& lost, const Centerlines& lines,
                                              const glm::dmat4& eye);

} // namespace ramus::render
