// The index of the paper's figures as one web page that needs nothing beside it, and the table of what was measured.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/figure_rows.h"
#include "app/reports/html.h"

#include <string>
#include <vector>

namespace ramus::app::paper {

struct MadeFigure {
    const FigureRow* row = nullptr;
    Figure figure;
};

// `inputs`: which trees and masks it is of; `made`: when.
[[nodiscard]] std::string paper_page(const std::vector<MadeFigure>& figures, const Facts& inputs,
                                     const std::string& made);

// All that was measured, of every figure; the closed form and what the paper says beside it.
[[nodiscard]] Table measured_table(const std::vector<MadeFigure>& figures);

} // namespace ramus::app::paper
