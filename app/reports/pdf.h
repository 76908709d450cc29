// Prints an HTML page to PDF: with weasyprint or, where that is missing, a browser.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"

#include <filesystem>
#include <string>

namespace ramus::app {

[[nodiscard]] bool is_pdf(const std::filesystem::path& path); // by its extension

// Fails if no program that prints is installed; checked at every call.
[[nodiscard]] Result<void> check_pdf_program();

// `html`: self-contained, UTF-8. The file is complete or absent. Fails as check_pdf_program(), with what the program
// says, and if `job` is cancelled.
[[nodiscard]] Result<void> write_pdf(const std::string& html, const std::filesystem::path& target, Job& job);

} // namespace ramus::app
