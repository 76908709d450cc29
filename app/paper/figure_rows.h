// The figures and tables of the paper that this project knows the content of, a row each: what it shows, what the paper
// says of it, and the function that makes it. The command line, the page and the documents' numbers follow this table.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/workbench.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app::paper {

struct FigureRow {
    std::string_view number; // "4", "III" of tables
    std::string_view title;
    std::string_view shows;              // what is made here
    std::string_view paper;              // what the paper has and says, as far as it is recorded
    std::string_view differs;            // what is not reproduced, or in which way
    std::vector<std::string_view> files; // all that are written for it
    Result<Figure> (*make)(Workbench&, Job&);
    [[nodiscard]] bool is_table() const { return number.find_first_not_of("IVX") == std::string_view::npos; }
    [[nodiscard]] std::string name() const { return (is_table() ? "Table " : "Figure ") + std::string(number); }
};

[[nodiscard]] const std::vector<FigureRow>& figure_rows(); // figures first, ascending, then tables

// "1,4", "5-7,III", in any order: the rows in theirs. None: it names what there is not.
[[nodiscard]] std::optional<std::vector<const FigureRow*>> rows_in(std::string_view list);
[[nodiscard]] std::string all_numbers(); // "1-13, I-III"

} // namespace ramus::app::paper
