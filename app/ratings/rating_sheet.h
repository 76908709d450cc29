// The sheet of one rater: a web page that needs nothing beside it, with the pictures inside. It asks for a score of
// each picture by each criterion and gives a file of answers. The page forbids the browser to load or send anything
// (Content-Security-Policy). It holds no method's name: neither in words, nor in its order, nor in the pictures.
#pragma once

#include "app/ratings/rating_study.h"
#include "core/base/error.h"
#include "core/io/output_file.h"

#include <filesystem>
#include <map>
#include <string>

namespace ramus::app {

using StudyPngs = std::map<std::string, std::string>; // code to the bytes of the file

// UTF-8. `rater` counts from 1 and has an order; each picture has its bytes.
[[nodiscard]] std::string rating_sheet(const RatingStudy& study, int rater, const StudyPngs& pngs);

// FOLDER/sheets/rater_001.html and so on in a folder that exists, and FOLDER/key.json. Returns the files of the sheets.
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_study(const RatingStudy& study, const StudyPngs& pngs,
                                                                     const std::filesystem::path& folder,
                                                                     io::OutputSet& together);

} // namespace ramus::app
