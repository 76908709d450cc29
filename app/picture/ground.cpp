#include "app/picture/ground.h"

namespace ramus::app {

namespace {

// Fog towards white would wash out far vessels (tuned by eye, on airways and vessels of the brain).
constexpr float kCueOnWhite = 0.35F, kCueOnGrey = 0.55F;

} // namespace

void put_on(render::Frame& frame, Ground ground) {
    frame.background = {};
    frame.background.transparent = ground == Ground::kTransparent;
    if (ground != Ground::kWhite && ground != Ground::kGrey) return;
    const bool white = ground == Ground::kWhite;
    frame.background.top = white ? glm::vec3(1.0F) : glm::vec3(0.66F, 0.68F, 0.70F);
    frame.background.bottom = white ? glm::vec3(1.0F) : glm::vec3(0.54F, 0.56F, 0.58F);
    frame.overlays.dark_ink = true;
    frame.appearance.depth_cue *= white ? kCueOnWhite : kCueOnGrey;
}

} // namespace ramus::app
