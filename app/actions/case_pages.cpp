#include "app/actions/case_pages.h"

#include "app/actions/report_pictures.h"
#include "app/assets/assets.h"
#include "app/session/numbers.h"
#include "app/workspace/surface_maker.h"
#include "core/base/words.h"
#include "core/mesh/surface.h"

#include <algorithm>

namespace ramus::app::actions {

Result<std::size_t> page_bytes_in(std::string_view megabytes) {
    constexpr double kLeast = 0.1, kMost = 2000.0; // MB; browsers read no longer text
    const auto wanted = parsed<double>(megabytes);
    if (!wanted || !(*wanted >= kLeast && *wanted <= kMost))
        return fail("\"" + std::string(megabytes) + "\" is not a size in MB from 0.1 to 2000", {}, kPageUsage);
    return static_cast<std::size_t>(*wanted * 1e6);
}

Result<PageChoice> page_choice(Arguments words) {
    PageChoice choice;
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const std::string& option = words[i];
        if (option != "--title" && option != "--size-limit" && option != "--without")
            return fail("page takes a file and what is in it", {}, kPageUsage);
        if (i + 1 == words.size()) return fail(option + " takes a value", {}, kPageUsage);
        const std::string& value = words[i + 1];
        if (option == "--title") choice.title = value;
        if (option == "--size-limit") {
            RAMUS_TRY(bytes, page_bytes_in(value));
            choice.most_bytes = bytes;
        }
        if (option != "--without") continue;
        const auto part = page_part_named(value);
        if (!part) return fail("a page has no part called " + value, {}, kPageUsage);
        choice.left_out.push_back(*part);
    }
    return choice;
}

Result<CasePage> make_case_page(ActionContext& context, const PageChoice& choice, glm::ivec2 shape, Job& job) {
    Document document = context.document;
    document.change(marks_without(document.marks(), choice.left_out, *document.tree()));
    Assets assets = context.assets;
    if (auto read = complete(assets, document, job); !read) return tl::unexpected(read.error());
    complete_contacts(assets, document);
    job.report(0.1F);
    ReportPictures pictures;
    if (!has_part(choice.left_out, PagePart::kViews)) {
        ActionContext reduced{.document = document, .picture = context.picture, .assets = assets};
        RAMUS_TRY(taken, take_report_pictures(reduced, shape));
        pictures = std::move(taken);
    }
    Job surface_job(job, 0.3F, 0.6F);
    mesh::SurfaceOptions options = as_drawn(document.marks().options);
    options.threads = choice.threads;
    RAMUS_TRY(surface, mesh::make_surface(*document.tree(), options, surface_job));
    return case_page({document, assets, surface.mesh, pictures}, choice, JobRange(job, 0.6F, 1.0F));
}

namespace {

void add_counted(std::string& text, std::size_t count, const char* one, const char* many) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
}

} // namespace

std::string page_contents(const Document& document, const PageChoice& choice) {
    const Marks marks = marks_without(document.marks(), choice.left_out, *document.tree());
    std::string text;
    add_counted(text, document.tree()->branches.size(), "branch", "branches");
    add_counted(text, marks.lesions.size(), "lesion", "lesions");
    add_counted(text, marks.cuts.size(), "cut", "cuts");
    add_counted(text, marks.resections.size(), "resection", "resections");
    if (marks.plans.count() > 1) add_counted(text, marks.plans.count(), "plan", "plans");
    add_counted(text, marks.measurements.size(), "measurement", "measurements");
    add_counted(text, marks.pins.size(), "pin", "pins");
    add_counted(text, marks.context.size(), "context surface", "context surfaces");
    add_counted(text, marks.views.size(), "saved view", "saved views");
    return text;
}

std::size_t expected_page_bytes(const Document& document, std::uint64_t triangles, const PageChoice& choice) {
    // Measured on trees of vessels and airways; pictures by three of the usual size.
    constexpr double kOfTriangle = 0.65, kOfBranch = 290.0, kOfPoint = 8.0, kOfPictures = 1.9e6, kOfView = 0.43e6,
                     kOfRest = 1e5;
    const tree::VesselTree& tree = *document.tree();
    const auto views = static_cast<double>(std::min(document.marks().views.size(), kMostPicturedViews));
    const double bytes = kOfTriangle * static_cast<double>(triangles) +
                         kOfBranch * static_cast<double>(tree.branches.size()) +
                         kOfPoint * static_cast<double>(tree.points.size()) + kOfRest +
                         (has_part(choice.left_out, PagePart::kViews) ? 0.0 : kOfPictures + views * kOfView);
    return std::min(static_cast<std::size_t>(bytes), choice.most_bytes);
}

std::string page_sentence(const CasePage& page, const std::string& file) {
    return "Page saved: " + file + "; " + digits(static_cast<double>(page.html.size()) / 1e6) + " MB. " +
           page.simplified;
}

} // namespace ramus::app::actions
