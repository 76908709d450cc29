#include "render/renderer/picture_state.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ramus::render {

bool PictureState::held() const {
    return is(Stage::kDrawn) || refining() || is(Stage::kFine) || is(Stage::kFineInParts);
}

void PictureState::begin() { stage_ = by_caster() ? Stage::kPartialOverCast : Stage::kPartial; }

void PictureState::interrupt() {
    constexpr std::pair<Stage, Stage> kGivenUp[] = {{Stage::kPartial, Stage::kAbandoned},
                                                    {Stage::kPartialOverCast, Stage::kCast},
                                                    {Stage::kRefining, Stage::kDrawn},
                                                    {Stage::kFiner, Stage::kFineInParts}};
    const auto* const found = std::ranges::find(kGivenUp, stage_, &std::pair<Stage, Stage>::first);
    if (found != std::end(kGivenUp)) stage_ = found->second;
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
