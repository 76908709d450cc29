#include "app/reports/html.h"

#include "app/session/numbers.h"
#include "core/io/binary_numbers.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 14px/1.45 "Open Sans", system-ui, sans-serif; color: #1d2126; margin: 2.2em auto; max-width: 60em; padding: 0 1.5em; }
h1 { font-size: 1.6em; font-weight: 600; margin: 0 0 .1em; overflow-wrap: anywhere; }
h2 { font-size: 1.1em; font-weight: 600; margin: 1.8em 0 .5em; padding-top: .7em; border-top: 1px solid #d5d9de; overflow-wrap: anywhere; }
h3 { font-size: 1em; font-weight: 600; margin: 1.3em 0 .3em; }
p { margin: .3em 0; }
.case { font-size: 1.15em; font-weight: 600; overflow-wrap: anywhere; }
.swatch { display: inline-block; width: .8em; height: .8em; margin-right: .4em; border: 1px solid #5b6570; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
.quiet, figcaption, dt, th { color: #5b6570; }
.pictures { display: grid; grid-template-columns: 1fr 1fr; gap: .7em; margin-top: 1.3em; }
.pictures figure:first-child { grid-column: 1 / -1; } .pictures.even figure:first-child { grid-column: auto; } .three .pictures { grid-template-columns: 1fr 1fr 1fr; break-inside: avoid; }
.wide { width: min(94vw, 90em); margin-left: 50%; transform: translateX(-50%); }
.plots { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(26em, 100%), 1fr)); gap: .8em 1.2em; margin: .8em 0; }
figure { margin: 0; } .pictures img { border: 1px solid #d5d9de; box-sizing: border-box; } img, svg { display: block; width: 100%; height: auto; } img { border-radius: 4px; }
figcaption { font-size: .85em; margin-top: .25em; }
dl { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(17em, 100%), 1fr)); gap: .15em 2em; margin: 0; }
dl div { display: flex; justify-content: space-between; gap: 1em; border-bottom: 1px solid #eceef1; padding: .12em 0; }
dd { margin: 0; text-align: right; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .88em; font-variant-numeric: tabular-nums; }
th { font-weight: 600; text-align: left; vertical-align: bottom; }
th, td { padding: .28em .5em; border-bottom: 1px solid #e3e6ea; } td { overflow-wrap: anywhere; }
td:not(.number) { min-width: 5em; }
.number { text-align: right; white-space: nowrap; } th.number { white-space: normal; }
tr.flag td { background: #fff1ec; } tr.sum td { font-weight: 600; border-top: 2px solid #aab2bb; }
.sums td:last-child { font-family: monospace; font-size: .84em; }
@media screen and (max-width: 40em) { body { margin: 1em auto; padding: 0 .8em; } .pictures { grid-template-columns: 1fr; } }
@media print { body { margin: 0; padding: 0; max-width: none; font-size: 11px; } h2, h3 { break-after: avoid; } tr, figure { break-inside: avoid; } thead { display: table-header-group; }
  .wide { width: auto; margin-left: 0; transform: none; } .scroll { overflow: visible; } .data-set, .page { break-before: page; }
  .pictures, .plots, dl { display: flex; flex-wrap: wrap; justify-content: space-between; gap: 0; }
  .pictures figure { width: 49%; margin-bottom: .7em; } .pictures figure:first-child { width: 100%; } .pictures.even figure:first-child { width: 49%; }
  .three .pictures figure, .three .pictures figure:first-child { width: 32.4%; } .plots > * { width: 49%; } dl div { width: 47%; }
  .pictures img { max-height: 125mm; object-fit: contain; } }
@page { size: A4; margin: 14mm 13mm 16mm; @bottom-right { content: counter(page) " / " counter(pages); font: 9px "Open Sans", sans-serif; color: #5b6570; } }
)";

constexpr std::string_view kNoLetter = "\xEF\xBF\xBD"; // U+FFFD

// Length in bytes of the first UTF-8 character; 0: invalid, or not allowed in a page.
std::size_t letter_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
    const std::size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    if (length == 0 || length > text.size()) return 0;
    std::uint32_t letter = first & (0xFFU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) return 0;
        letter = letter << 6U | (byte(i) & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000}; // no overlong encodings
    const bool is_half = letter >= 0xD800 && letter < 0xE000;                  // surrogates of UTF-16
    return letter < kLeast[length] || letter > 0x10FFFF || is_half || letter == 0xFFFE || letter == 0xFFFF ? 0 : length;
}

// A swatch before the text of a colour: "#c98268".
std::string swatch(const Column& column, const Cell& cell) {
    const bool colour = column.name == "colour" && cell.text.size() == 7 && cell.text[0] == '#' &&
                        cell.text.find_first_not_of("0123456789abcdef", 1) == std::string::npos;
    return colour ? "<span class=\"swatch\" style=\"background:" + cell.text + "\"></span>" : "";
}

bool numeric(const Table& table, std::size_t column) {
    return !table.rows.empty() && table.rows.front()[column].number.has_value();
}

std::string row_html(const Table& table, const std::vector<Cell>& row, const TableLook& look, bool sum) {
    bool flagged = false;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        flagged = flagged || (table.columns[c].name == look.flag_column && row[c].text == "yes");
    std::string text = sum ? "<tr class=\"sum\">" : flagged ? "<tr class=\"flag\">" : "<tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        text += std::string("<td") + (numeric(table, c) ? " class=\"number\">" : ">") +
                swatch(table.columns[c], row[c]) + html_text(text_of(row[c], table.columns[c].digits)) + "</td>";
    return text + "</tr>\n";
}

std::string figures_html(const std::vector<ReportPicture>& pictures) {
    std::string text;
    for (const ReportPicture& picture : pictures)
        text += "<figure><img alt=\"" + html_text(picture.caption) + "\" src=\"data:image/png;base64," +
                io::base64_encoded(picture.png) + "\"><figcaption>" + html_text(picture.caption) +
                "</figcaption></figure>\n";
    return text;
}

} // namespace

std::string html_text(std::string_view text) {
    std::string safe;
    for (std::size_t i = 0; i < text.size();) {
        constexpr std::array<std::pair<char, std::string_view>, 5> kSafe{
            {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}}};
        const char c = text[i];
        const auto* const found = std::ranges::find(kSafe, c, &std::pair<char, std::string_view>::first);
        const std::size_t length = letter_length(text.substr(i));
        if (found != kSafe.end())
            safe += found->second;
        else
            safe += length > 0 ? text.substr(i, length) : kNoLetter;
        i += std::max<std::size_t>(length, 1);
    }
    return safe;
}

std::string script_json(const nlohmann::ordered_json& value) {
    std::string text;
    for (const char c : value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace))
        c == '<' ? text += "\\u003c" : text += c;
    return text;
}

std::string filled(std::string_view text, const PageTexts& parts) {
    std::string page;
    for (std::size_t open = text.find("{{"); open != std::string_view::npos; open = text.find("{{")) {
        const std::size_t close = text.find("}}", open);
        page.append(text.substr(0, open)).append(parts.find(text.substr(open + 2, close - open - 2))->second);
        text.remove_prefix(close + 2);
    }
    return page.append(text);
}

std::string text_of(const Cell& cell, int significant) {
    if (!cell.number) return cell.text;
    const double number = *cell.number;
    if (!std::isfinite(number)) return "\xE2\x80\x93";
    if (number == std::floor(number) && std::abs(number) < 1e9)
        return std::string(number < 0.0 ? "-" : "").append(grouped(static_cast<std::uint64_t>(std::abs(number))));
    return digits(number, significant);
}

std::string now_text() { return local_time_text(std::chrono::system_clock::now()); }

std::string page_begin(const std::string& title, const std::string& what, const std::string& made) {
    const std::string name = html_text(title);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           // As in rating pages, without their script: nothing runs and nothing is loaded, whatever names contain.
           "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
           "'unsafe-inline'; form-action 'none'; base-uri 'none'\">\n<meta name=\"referrer\" content=\"no-referrer\">\n"
           "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
           name + " \xE2\x80\x93 ramus report</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" + name +
           "</h1>\n<p class=\"quiet\">" + html_text(what) + ", ramus " RAMUS_VERSION ", " + html_text(made) +
           ". Not a medical device.</p>\n";
}

std::string page_end() { return "</body>\n</html>\n"; }

std::string facts_html(const Facts& facts) {
    std::string text = "<dl>\n";
    for (const auto& [name, value] : facts)
        text += "<div><dt>" + html_text(name) + "</dt><dd>" + html_text(value) + "</dd></div>\n";
    return text + "</dl>\n";
}

std::string pictures_html(const std::vector<ReportPicture>& pictures) {
    if (pictures.size() == 2) return even_pictures_html(pictures);
    return pictures.empty() ? "" : "<div class=\"pictures\">\n" + figures_html(pictures) + "</div>\n";
}

std::string even_pictures_html(const std::vector<ReportPicture>& pictures) {
    return pictures.empty() ? "" : "<div class=\"pictures even\">\n" + figures_html(pictures) + "</div>\n";
}

std::string table_html(const Table& all, const TableLook& look) {
    const Table table = in_words(all);
    const std::string heading = look.is_part ? "h3>" : "h2>";
    std::string text = "<" + heading + html_text(table.title) + "</" + heading + "\n";
    if (!look.note.empty()) text += "<p class=\"quiet\">" + html_text(look.note) + "</p>\n";
    if (table.rows.empty()) return text;
    text += "<div class=\"scroll\"><table>\n<thead><tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        text += std::string("<th") + (numeric(table, c) ? " class=\"number\">" : ">") +
                html_text(table.columns[c].heading) + "</th>";
    text += "</tr></thead>\n<tbody>\n";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const bool sum = r + look.sums >= table.rows.size();
        if (r < look.most_rows || sum) text += row_html(table, table.rows[r], look, sum);
    }
    text += "</tbody></table></div>\n";
    if (const std::size_t shown = look.most_rows + look.sums; table.rows.size() > shown)
        text += "<p class=\"quiet\">And " + grouped(table.rows.size() - shown) + " more, which " +
                html_text(look.all_rows_in) + " lists.</p>\n";
    return text;
}

} // namespace ramus::app
