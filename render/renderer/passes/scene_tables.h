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
    Buffer block_;
    TexelTable lesions_{GL_RGBA32F}, cuts_{GL_RGBA32F}, context_{GL_RGBA32F};
    Texture ramp_;                              // RGB16F, 8 bytes a colour
    Texture distances_;                         // R32F, 4 bytes a sample
    std::shared_ptr<const DistanceGrid> shown_; // in distances_
};

} // namespace ramus::render
