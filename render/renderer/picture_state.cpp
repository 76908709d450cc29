#include "render/renderer/picture_state.h"

namespace ramus::render {

bool PictureState::held() const {
    return is(Stage::kDrawn) || refining() || is(Stage::kFine) || is(Stage::kFineInParts);
}

void PictureState::begin() { stage_ = by_caster() ? Stage::kPartialOverCast : Stage::kPartial; }

void PictureState::interrupt() {
    switch (stage_) {
    case Stage::kPartial:
        stage_ = Stage::kAbandoned;
        break;
    case Stage::kPartialOverCast:
        stage_ = Stage::kCast;
        break;
    case Stage::kRefining:
        stage_ = Stage::kDrawn;
        break;
    case Stage::kFiner:
        stage_ = Stage::kFineInParts;
        break;
    default:
        break;
    }
}

void PictureState::finish() {
    if (partial()) stage_ = Stage::kDrawn;
}

void PictureState::shade() {
    if (held()) stage_ = Stage::kDrawn;
}

void PictureState::shade_changed() {
    if (!held()) return;
    stage_ = is(Stage::kDrawn) || is(Stage::kRefining) ? Stage::kDrawn : Stage::kFineInParts;
}

void PictureState::begin_refining() {
    if (is(Stage::kDrawn) || is(Stage::kFineInParts)) stage_ = Stage::kRefining;
}

void PictureState::show_mean() {
    if (refining()) stage_ = Stage::kFiner;
}

void PictureState::end_refining() {
    if (can_refine()) stage_ = Stage::kFine;
}

} // namespace ramus::render
