// Marks as JSON of session files. Invalid values throw Refusal (app/session/json_values.h). `folder`: of the session
// file.
#pragma once

#include "app/session/session.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace ramus::app::session_json {

// The path written into a file in `folder`: relative if `file` lies below `folder`, otherwise absolute.
[[nodiscard]] std::filesystem::path written_path(const std::filesystem::path& file,
                                                 const std::filesystem::path& folder);

// `marks` must contain the lesions that measurements refer to.
[[nodiscard]] nlohmann::json measurement_json(const Measurement& m, const Marks& marks);
[[nodiscard]] Measurement measurement_in(const nlohmann::json& value, const Marks& marks);
[[nodiscard]] std::string mesh_axes_in(const nlohmann::json& value); // "LPS" or "RAS"
[[nodiscard]] std::string units_in(const nlohmann::json& value);     // of length
// A label of a mask: a number, or a name.
[[nodiscard]] nlohmann::json label_json(const volume::LabelChoice& label);
[[nodiscard]] volume::LabelChoice label_in(const nlohmann::json& value);
// The list of labels under this key; empty if it is missing.
[[nodiscard]] std::vector<volume::LabelChoice> labels_in(const nlohmann::json& object, const std::string& key);

// A lesion that others refer to, by its id: "sphere 2", "mesh 1", counted from 1 among those of its shape; empty: none.
[[nodiscard]] std::string lesion_json(int id, const Marks& marks);
[[nodiscard]] int lesion_in(const nlohmann::json& value, const Marks& marks);

[[nodiscard]] nlohmann::json resection_json(const Resection& resection, const Marks& marks,
                                            const std::filesystem::path& folder);
[[nodiscard]] Resection resection_in(const nlohmann::json& value, const Marks& marks,
                                     const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json plans_json(const Marks& marks, const std::filesystem::path& folder); // Marks::plans
[[nodiscard]] Plans plans_in(const nlohmann::json& value, const Marks& marks, const std::filesystem::path& folder);
[[nodiscard]] std::pair<int, double> cut_in(const nlohmann::json& value);

[[nodiscard]] nlohmann::json comparison_json(const Comparison& comparison, const std::filesystem::path& folder);
[[nodiscard]] Comparison comparison_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json deviation_json(const DeviationChoice& choice, const std::filesystem::path& folder);
[[nodiscard]] DeviationChoice deviation_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json organ_json(const OrganChoice& choice, const std::filesystem::path& folder);
[[nodiscard]] OrganChoice organ_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] nlohmann::json context_json(const ContextItem& item, const std::filesystem::path& folder);
[[nodiscard]] ContextItem context_in(const nlohmann::json& value, const std::filesystem::path& folder);
[[nodiscard]] tree::System system_in(const nlohmann::json& value);

} // namespace ramus::app::session_json
