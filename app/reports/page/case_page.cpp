#include "app/reports/page/case_page.h"

#include "app/assets/assets.h"
#include "app/reports/html.h"
#include "app/reports/page/case_json.h"
#include "app/reports/page/case_page_texts.h"
#include "app/reports/page/page_blob.h"
#include "app/reports/page/page_surface.h"
#include "app/reports/table_kinds.h"
#include "app/session/numbers.h"
#include "core/io/checksum.h"

#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>
#include <utility>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

std::string policy() {
    return "default-src 'none'; script-src 'sha256-" + io::sha256_base64(kCasePageTexts.at("page.js")) +
           "'; style-src 'sha256-" + io::sha256_base64(kCasePageTexts.at("page.css")) +
           "'; img-src data: blob:; form-action 'none'; base-uri 'none'";
}

// The file's centerlines, x, y, z and radius of each point; not smoothed, as lengths are measured on them.
ordered_json centerlines_json(const tree::VesselTree& tree, PageBlob& blob) {
    std::vector<glm::vec4> points;
    std::vector<std::uint32_t> counts;
    for (const tree::Branch& branch : tree.branches) {
        for (const std::uint32_t point : branch.points)
            points.emplace_back(glm::vec3(tree.points[point].position), static_cast<float>(tree.points[point].radius));
        counts.push_back(static_cast<std::uint32_t>(branch.points.size()));
    }
    return {{"points", blob.add(deflated_numbers(std::span<const glm::vec4>(points)))},
            {"counts", blob.add(deflated_numbers(std::span<const std::uint32_t>(counts)))}};
}

// Pictures and tables, for browsers without WebGL and for print.
std::string report_html(const PageCase& of, const PageChoice& choice) {
    std::string html;
    if (!has_part(choice.left_out, PagePart::kViews)) {
        html += pictures_html(of.pictures.general) + even_pictures_html(of.pictures.saved_views);
        for (const std::vector<ReportPicture>& plan : of.pictures.plans) html += even_pictures_html(plan);
        for (const SliceRow& row : of.pictures.slices)
            html += "<h3>" + html_text(row.title) + "</h3>\n" + even_pictures_html(row.pictures);
    }
    if (has_part(choice.left_out, PagePart::kTables)) return html;
    for (const TableKind& kind : table_kinds()) {
        if (!kind.there(of.document, of.assets)) continue;
        Table table = kind.table(of.document, of.assets);
        for (Column& column : table.columns) // its swatches have styles of their own, which the page forbids
            if (column.name == "colour") column.name = "colour_text";
        html += table_html(table, {.all_rows_in = "the tables of the page"});
    }
    return html;
}

std::string title_of(const Document& document, const PageChoice& choice) {
    if (!choice.title.empty()) return choice.title;
    return has_part(choice.left_out, PagePart::kNames) ? "Vessel tree"
                                                       : document.session().tree.path.filename().string();
}

CaseHead head_of(const Document& document, const PageChoice& choice) {
    CaseHead head;
    head.title = title_of(document, choice);
    head.made = now_text().substr(0, 10);
    head.ground = choice.ground;
    head.tables = !has_part(choice.left_out, PagePart::kTables);
    const std::filesystem::path& path = document.session().tree.path;
    if (!has_part(choice.left_out, PagePart::kNames)) head.file = path.filename().string();
    if (const auto sum = io::sha256_of(path)) head.checksum = *sum;
    return head;
}

std::string simplified_text(const PageSurface& surface, const Lengths& lengths) {
    const bool is_whole = surface.packed.triangles >= surface.triangles_before; // more along borders of branches
    std::string text = is_whole ? "The surface has all of its " + grouped(surface.triangles_before) + " triangles"
                                : "The surface has " + grouped(surface.packed.triangles) + " triangles instead of " +
                                      grouped(surface.triangles_before);
    text += ". No vertex of the whole surface is more than " + lengths.text(surface.largest_deviation_mm) +
            " away from it, and 95 % are less than " + lengths.text(surface.percentile_95_mm) + " away.";
    if (surface.for_size) text += " It was simplified this much for the size of the file.";
    return text;
}

struct PageTextsOfCase {
    std::string json, report, title, policy;
};

std::size_t bytes_of_frame(const PageTextsOfCase& texts) {
    std::size_t bytes = texts.json.size() + texts.report.size() + 2 * texts.title.size() + texts.policy.size();
    for (const auto& [name, text] : kCasePageTexts) bytes += text.size();
    return bytes;
}

std::string page_of(const PageTextsOfCase& texts, const PageBlob& blob) {
    return filled(kCasePageTexts.at("page.html"), {{"csp", texts.policy},
                                                   {"title", texts.title},
                                                   {"style", kCasePageTexts.at("page.css")},
                                                   {"report", texts.report},
                                                   {"case", texts.json},
                                                   {"geometry", blob.text()},
                                                   {"script", kCasePageTexts.at("page.js")}});
}

} // namespace

Result<CasePage> case_page(const PageCase& of, const PageChoice& choice, const JobRange& job) {
    const CaseHead head = head_of(of.document, choice);
    PageMeshes meshes;
    ordered_json json = case_json(of.document, of.assets, head, meshes);
    PageTextsOfCase texts{{}, report_html(of, choice), html_text(head.title), policy()};
    CasePage page;
    PageBlob blob;
    auto add_size = [&page, last = std::size_t{0}](const char* what, std::size_t total) mutable {
        page.sizes.emplace_back(what, total - std::exchange(last, total));
    };
    json["centerlines"] = centerlines_json(*of.document.tree(), blob);
    add_size("centerlines", blob.text().size());
    for (const auto& mesh : meshes.list) {
        json["meshes"].push_back(blob.add(page_mesh(*mesh)));
        if (job.cancelled()) return fail("cancelled");
    }
    add_size("other surfaces", blob.text().size());
    constexpr std::size_t kTableBytes = 4000; // of the sentence on the surface and its place in the file
    texts.json = script_json(json);
    const std::size_t besides = bytes_of_frame(texts) + blob.text().size() + kTableBytes;
    if (besides >= choice.most_bytes)
        return fail("the page would be larger than its limit: without the surface it has " + grouped(besides / 1000) +
                        " kB of " + grouped(choice.most_bytes / 1000) + " kB",
                    {}, "raise --size-limit, or leave more out: --without views");
    const PageSurfaceChoice room{choice.most_bytes - besides, 0.02};
    RAMUS_TRY(surface, page_surface(of.surface, of.document.dependency(), room, job));
    json["surface"] = blob.add(surface.packed);
    add_size("surface", blob.text().size());
    page.simplified = json["simplified"] = simplified_text(surface, of.document.lengths());
    json["buffers"] = blob.table();
    texts.json = script_json(json);
    page.sizes.insert(page.sizes.end(), {{"facts and tables", texts.json.size()},
                                         {"pictures and tables of the report", texts.report.size()},
                                         {"script", kCasePageTexts.at("page.js").size()}});
    page.triangles = surface.packed.triangles;
    page.triangles_before = surface.triangles_before;
    page.largest_deviation_mm = surface.largest_deviation_mm;
    page.html = page_of(texts, blob);
    return page;
}

} // namespace ramus::app
