// Writes the rating page of one rater: a self-contained web page with all pictures inside. It asks for a score per
// picture and criterion, and saves a file of answers. The page forbids the browser to load or send anything
// (Content-Security-Policy). It does not reveal the methods: neither by text, nor by order, nor by the pictures' data.
#pragma once

#include "app/ratings/rating_study.h"
#include "core/base/error.h"
#include "core/io/output_file.h"

#include <filesystem>
#include <map>
#include <string>

namespace ramus::app {

using StudyPngs = std::map<std::string, std::string>; // code to the bytes of the file

// Returns UTF-8. `rater`: counted from 1, must have an order; `pngs` must have every picture.
[[nodiscard]] std::string rating_page(const RatingStudy& study, int rater, const StudyPngs& pngs);

// Writes FOLDER/sheets/rater_001.html, ... and FOLDER/key.json; FOLDER must exist. Returns the rating pages.
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_study(const RatingStudy& study, const StudyPngs& pngs,
                                                                     const std::filesystem::path& folder,
                                                                     io::OutputSet& together);

} // namespace ramus::app
