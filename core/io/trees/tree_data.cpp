#include "core/io/trees/tree_data.h"

#include "core/base/printable.h"
#include "core/base/words.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace ramus::io {

namespace {

constexpr std::size_t kLongestName = 80; // bytes

// Printable and of limited length. Idempotent, also for a result with a number after it.
std::string tidy_name(std::string_view name) {
    using nlohmann::json;
    const std::string utf8 = json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace));
    std::string tidy = printable(trimmed(utf8));
    constexpr std::size_t kNumber = 16;
    if (tidy.size() > kLongestName + kNumber) {
        std::size_t end = kLongestName;
        while (end > 0 && (static_cast<unsigned char>(tidy[end]) & 0xC0U) == 0x80U) --end; // not inside a character
        tidy = std::string(trimmed(std::string_view(tidy).substr(0, end)));
    }
    return tidy.empty() ? "unnamed" : tidy;
}

Result<void> check_sizes(const tree::DataArrays& arrays, std::size_t count, const char* things,
                         const ImportedTree& imported) {
    for (const tree::DataArray& array : arrays)
        if (array.values.size() != count)
            return fail("the array " + shown(array.name) + " has " + counted(array.values.size(), "value") + " for " +
                            std::to_string(count) + " " + things,
                        imported.place_of(0), "correct the file");
    return {};
}

} // namespace

std::optional<double> data_value(std::string_view cell) {
    cell = trimmed(cell);
    if (cell.empty()) return tree::kUnknownValue;
    if (const auto value = to_real(cell)) return std::isfinite(*value) ? *value : tree::kUnknownValue;
    const std::string word = lower_case(cell);
    if (word == "na" || word == "n/a" || word == "null" || word == "none") return tree::kUnknownValue;
    return std::nullopt;
}

DataColumns::DataColumns(std::vector<std::string> names)
    : names_(std::move(names)), values_(names_.size()), is_text_(names_.size(), 0) {}

void DataColumns::add_row(std::span<const std::string_view> cells) {
    for (std::size_t c = 0; c < names_.size(); ++c) {
        if (is_text_[c] != 0) continue;
        const auto value = c < cells.size() ? data_value(cells[c]) : tree::kUnknownValue;
        if (value) {
            values_[c].push_back(*value);
        } else {
            is_text_[c] = 1;
            values_[c] = {};
        }
    }
}

tree::DataArrays DataColumns::arrays(std::vector<std::string>& left_out) const {
    tree::DataArrays arrays;
    for (std::size_t c = 0; c < names_.size(); ++c) {
        if (is_text_[c] != 0)
            left_out.push_back(names_[c]);
        else
            arrays.push_back({names_[c], values_[c]});
    }
    return arrays;
}

std::size_t SparseData::array(std::string_view name) {
    const auto at = std::ranges::find(arrays_, name, &tree::DataArray::name);
    if (at != arrays_.end()) return static_cast<std::size_t>(at - arrays_.begin());
    too_many_ |= arrays_.size() == tree::kMostArrays;
    if (arrays_.size() == tree::kMostArrays) return kNoArray;
    arrays_.push_back({std::string(name), {}});
    return arrays_.size() - 1;
}

void SparseData::set(std::size_t array, std::size_t index, double value) {
    if (array == kNoArray) return;
    std::vector<double>& values = arrays_[array].values;
    if (values.size() <= index) values.resize(index + 1, tree::kUnknownValue);
    values[index] = value;
}

tree::DataArrays SparseData::arrays(std::size_t count, ImportedTree& imported) && {
    for (tree::DataArray& array : arrays_) array.values.resize(count, tree::kUnknownValue);
    if (too_many_)
        imported.assume("data", "arrays beyond the first " + std::to_string(tree::kMostArrays) + " were left out");
    return std::move(arrays_);
}

Result<void> settle_data(ImportedTree& imported) {
    tree::Graph& graph = imported.graph;
    if (auto good = check_sizes(graph.point_data, graph.points.size(), "points", imported); !good) return good;
    if (auto good = check_sizes(graph.edge_data, graph.edges.size(), "connections", imported); !good) return good;
    std::set<std::string> names;
    std::size_t too_many = 0;
    for (tree::DataArrays* arrays : {&graph.point_data, &graph.edge_data}) {
        tree::DataArrays kept;
        for (tree::DataArray& array : *arrays) {
            for (double& value : array.values)
                if (!tree::is_known(value)) value = tree::kUnknownValue;
            if (tree::range_of(array).known == 0) continue;
            if (names.size() == tree::kMostArrays) {
                ++too_many;
                continue;
            }
            const std::string name = tidy_name(array.name);
            array.name = name;
            for (int n = 2; !names.insert(array.name).second; ++n) array.name = name + "_" + std::to_string(n);
            kept.push_back(std::move(array));
        }
        std::ranges::stable_sort(kept, {}, &tree::DataArray::name); // the order of keys in JSON
        *arrays = std::move(kept);
    }
    if (too_many > 0)
        imported.assume("data", counted(too_many, "array") + " beyond the first " + std::to_string(tree::kMostArrays) +
                                    " were left out");
    if (imported.left_out.empty()) return {};
    constexpr std::size_t kNamed = 6;
    const std::size_t count = imported.left_out.size();
    std::string list;
    for (std::size_t n = 0; n < std::min(count, kNamed); ++n)
        list += (n > 0 ? ", " : "") + tidy_name(imported.left_out[n]);
    if (count > kNamed) list += " and " + std::to_string(count - kNamed) + " more";
    imported.assume("data", "left out, since they are not one number for each point or branch: " + list);
    return {};
}

std::string name_in_file(const std::string& name, std::span<const std::string_view> taken) {
    return std::ranges::find(taken, lower_case(name)) == taken.end() ? name : name + "_data";
}

} // namespace ramus::io
