// The whole case as one web page: a self-contained file that any browser opens, without a server and without a network.
// The page forbids the browser to load or send anything (Content-Security-Policy); only its own script and style, by
// their checksums, take effect. Without WebGL it shows the pictures and tables of a report.
//
// Guaranteed: no path of this machine is in the page, and with `left_out` nothing of these parts is. Text from files
// and people is data: it is never part of the page's markup or script.
#pragma once

#include "app/picture/ground.h"
#include "app/reports/page/page_parts.h"
#include "app/reports/report_page.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

inline constexpr std::size_t kUsualPageBytes = 12'000'000;

struct PageChoice {
    std::string title; // empty: the name of the file
    std::size_t most_bytes = kUsualPageBytes;
    std::vector<PagePart> left_out;
    Ground ground = Ground::kDark;
    int threads = 0; // 0: one for each core
};

struct CasePage {
    std::string html;
    std::vector<std::pair<std::string, std::size_t>> sizes; // of the parts of the page, bytes
    std::size_t triangles = 0, triangles_before = 0;
    double largest_deviation_mm = 0.0;
    std::string simplified; // a sentence
};

// What the page is made of. The document has a tree and the marks of marks_without(); the assets are complete.
struct PageCase {
    const Document& document;
    const Assets& assets;
    const mesh::TriangleMesh& surface; // of all branches, also hidden ones
    const ReportPictures& pictures;
};

// Fails if the page would be larger than `most_bytes`, or when cancelled.
[[nodiscard]] Result<CasePage> case_page(const PageCase& of, const PageChoice& choice, const JobRange& job);

} // namespace ramus::app
