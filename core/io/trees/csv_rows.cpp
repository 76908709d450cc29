#include "core/io/trees/csv_rows.h"

#include "core/io/text_numbers.h"

#include <algorithm>
#include <utility>

namespace ramus::io {

CsvRows::CsvRows(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    const std::string_view first = text_.substr(0, text_.find_first_of("\r\n", text_.find_first_not_of("\r\n")));
    std::ptrdiff_t most = 0;
    for (const char c : {';', ',', '\t'})
        if (const auto count = std::ranges::count(first, c); count > most) most = count, separator_ = c;
}

Result<std::string_view> CsvRows::cell() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (at_ >= text_.size() || text_[at_] != '"') {
        const char ends[] = {separator_, '\r', '\n', '\0'};
        const std::size_t end = std::min(text_.find_first_of(std::string_view(ends, 3), at_), text_.size());
        const std::size_t begin = std::exchange(at_, end);
        return trimmed(text_.substr(begin, end - begin));
    }
    std::string& value = unquoted_.emplace_back();
    for (++at_;; ++at_) {
        const std::size_t quote = text_.find('"', at_);
        if (quote == std::string_view::npos)
            return fail("a cell in quotes does not end", place(), "the file is incomplete; get it again");
        const std::string_view part = text_.substr(at_, quote - at_);
        next_line_ += static_cast<std::size_t>(std::ranges::count(part, '\n'));
        value += part;
        at_ = quote + 1;
        if (at_ >= text_.size() || text_[at_] != '"') break;
        value += '"';
    }
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\r' && text_[at_] != '\n')
        return fail("there is more in a cell behind its closing quote", place(), "correct the file");
    return value;
}

Result<bool> CsvRows::next(std::vector<std::string_view>& cells) {
    unquoted_.clear();
    do {
        cells.clear();
        if (at_ >= text_.size()) return false;
        line_ = next_line_;
        for (bool more = true; more;) {
            RAMUS_TRY(value, cell());
            if (value.starts_with('\'') && begins_formula(value.substr(1))) value.remove_prefix(1);
            cells.push_back(value);
            more = at_ < text_.size() && text_[at_] == separator_;
            if (more) ++at_;
        }
        if (at_ < text_.size() && text_[at_] == '\r') ++at_;
        if (at_ < text_.size() && text_[at_] == '\n') ++at_;
        ++next_line_;
    } while (cells.size() == 1 && cells.front().empty());
    return true;
}

} // namespace ramus::io
