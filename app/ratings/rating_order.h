// In which order a rater sees what is to be rated. The same seed gives the same orders on every machine, and a rater's
// order does not change when there are more raters.
#pragma once

#include "app/ratings/rating_study.h"

namespace ramus::app {

// For rater 1 and so on. Scenes come in any order. Of each scene, every so many raters as there are orders of its
// pictures (six of three pictures) see each order once, so that no method is more often first or beside another.
[[nodiscard]] std::vector<RaterOrder> rater_orders(const RatingStudy& study, int raters);

} // namespace ramus::app
