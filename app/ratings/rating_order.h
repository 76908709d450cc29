// The order in which each rater sees study views and pictures. Deterministic: a seed gives the same orders on every
// machine, and a rater's order does not depend on the number of raters.
#pragma once

#include "app/ratings/rating_study.h"

namespace ramus::app {

// For raters from 1. Study views are in random order. The pictures of a study view are balanced: among as many
// consecutive raters as there are orders of its pictures (six for three pictures) each order occurs once, so that no
// method is first, or next to another one, more often.
[[nodiscard]] std::vector<RaterOrder> rater_orders(const RatingStudy& study, int raters);

} // namespace ramus::app
