// Consumes the long lists of a ramus tree file (tree_json.h) while it is parsed, so memory holds their numbers and no
// JSON value for each. Internal to the reader.
#pragma once

#include "core/base/error.h"
#include "core/io/json_text.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramus::io {

inline constexpr std::pair<tree::Note::Kind, const char*> kNoteKinds[] = {{tree::Note::Kind::kAssumed, "assumed"},
                                                                          {tree::Note::Kind::kRepaired, "repaired"},
                                                                          {tree::Note::Kind::kSuspect, "suspect"}};

// An exception, because the checks are many and deep. parse_tree_json() catches it and returns its Error.
struct RefusedTreeJson {
    Error error;
};

// Gets typed values; throws RefusedTreeJson with the place of a value of another type.
class TreeJsonValues {
public:
    explicit TreeJsonValues(const std::string& name) : name_(name) {}

    [[noreturn]] void refuse(const std::string& place, const std::string& what,
                             const std::string& hint = "edit the file or write it anew with `ramus convert`") const {
        throw RefusedTreeJson{{what, place.empty() ? name_ : name_ + ": " + place, hint}};
    }
    static std::string element(const std::string& list, std::size_t i) { return list + "[" + std::to_string(i) + "]"; }

    [[nodiscard]] std::string string(const nlohmann::json& value, const std::string& place) const {
        if (!value.is_string()) refuse(place, "is not text");
        return value.get<std::string>();
    }
    template <std::size_t N>
    [[nodiscard]] std::array<double, N> numbers(const nlohmann::json& row, const std::string& place,
                                                const char* form) const {
        if (!row.is_array() || row.size() != N) refuse(place, std::string("is not ") + form);
        std::array<double, N> values{};
        for (std::size_t c = 0; c < N; ++c) {
            if (!row[c].is_number()) refuse(element(place, c), "is not a number");
            values[c] = row[c].get<double>();
        }
        return values;
    }

private:
    const std::string& name_;
};

class TreeJsonLists {
public:
    explicit TreeJsonLists(const TreeJsonValues& values) : values_(values) {}

    std::vector<tree::Point> points;
    std::vector<int> labels;
    std::vector<std::uint32_t> roots, branch_systems;                   // kNoJsonIndex: invalid index
    std::map<std::string, std::vector<double>> point_data, branch_data; // at most kMostArrays + 1 names
    std::vector<tree::Note> notes, repairs;
    std::optional<Error> wrong; // the first error; nothing is read after it

    [[nodiscard]] std::size_t branches() const { return ends_.size(); }
    // The indices of the branch's points.
    [[nodiscard]] std::span<const std::uint32_t> branch(std::size_t number) const {
        const std::size_t first = number == 0 ? 0 : ends_[number - 1];
        return std::span(vertices_).subspan(first, ends_[number] - first);
    }

    // The `lists` argument of parsed_json(). Unknown lists are dropped.
    [[nodiscard]] JsonElements taker_of(JsonPath list);

private:
    template <class Take> JsonElements checked(const Take& take);
    JsonElements indices_of(std::vector<std::uint32_t>& into);
    JsonElements data_of(std::map<std::string, std::vector<double>>& arrays, const std::string& key,
                         const std::string& name);
    JsonElements whole_list(const std::string& key);
    void take_coordinate(const nlohmann::json& value);
    void take_point(const nlohmann::json& row);
    void take_branch(const nlohmann::json& row);
    void take_label(const nlohmann::json& value);
    void take_note(const nlohmann::json& note);

    const TreeJsonValues& values_;
    std::array<double, 4> coordinates_{}; // of the current point
    std::size_t coordinate_ = 0;
    std::vector<std::uint32_t> vertices_;
    std::vector<std::size_t> ends_; // by branch
};

} // namespace ramus::io
