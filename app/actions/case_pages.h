// Makes the page for browsers of a document: leaves out what is not wanted, computes what is missing, draws the
// pictures. For the command `page` and for `ramus page`.
#pragma once

#include "app/actions/action.h"
#include "app/reports/page/case_page.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>

namespace ramus::app::actions {

inline constexpr const char* kPageUsage =
    "page FILE.html [--title TEXT] [--size-limit MB] [--without PART]..., where PART is names, measurements, lesions, "
    "plans, tables, views or context";

// The options after the file.
[[nodiscard]] Result<PageChoice> page_choice(Arguments words);
// The size in MB, as people write it: "12" or "2.5"; at least 0.1.
[[nodiscard]] Result<std::size_t> page_bytes_in(std::string_view megabytes);

// `shape`: of the picture of the view as it is. Without pictures the host of the context draws nothing. Fails as
// case_page(), or if a file of the session cannot be read.
[[nodiscard]] Result<CasePage> make_case_page(ActionContext& context, const PageChoice& choice, glm::ivec2 shape,
                                              Job& job);

// What a page would have, for the dialog: "1,504 branches, 2 lesions, plans A and B".
[[nodiscard]] std::string page_contents(const Document& document, const PageChoice& choice);
// A rough estimate of its size, from the number of triangles of the surface.
[[nodiscard]] std::size_t expected_page_bytes(const Document& document, std::uint64_t triangles,
                                              const PageChoice& choice);

// "Page saved: FILE; 5.1 MB".
[[nodiscard]] std::string page_sentence(const CasePage& page, const std::string& file);

} // namespace ramus::app::actions
