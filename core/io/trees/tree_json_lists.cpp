#include "core/io/trees/tree_json_lists.h"

#include "core/io/trees/json_input.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::io {

using nlohmann::json;

template <class Take> JsonElements TreeJsonLists::checked(const Take& take) {
    return [this, take](const json& value) {
        if (wrong) return;
        try {
            take(value);
        } catch (RefusedTreeJson& refused) {
            wrong = std::move(refused.error);
        }
    };
}

JsonElements TreeJsonLists::indices_of(std::vector<std::uint32_t>& into) {
    into.clear();
    return [&into](const json& value) { into.push_back(json_index(value)); };
}

JsonElements TreeJsonLists::data_of(std::map<std::string, std::vector<double>>& arrays, const std::string& key,
                                    const std::string& name) {
    if (arrays.size() > tree::kMostArrays) return [](json& /*value*/) {}; // refused later
    std::vector<double>& values = arrays[name];
    values.clear();
    return checked([this, &values, place = key + "." + name](const json& value) {
        if (!value.is_number() && !value.is_null())
            values_.refuse(TreeJsonValues::element(place, values.size()), "is neither a number nor null");
        values.push_back(value.is_null() ? tree::kUnknownValue : value.get<double>());
    });
}

JsonElements TreeJsonLists::whole_list(const std::string& key) {
    if (key == "points") {
        points.clear();
        return checked([this](const json& row) { take_point(row); });
    }
    if (key == "branches") {
        vertices_.clear(), ends_.clear();
        return checked([this](const json& row) { take_branch(row); });
    }
    if (key == "labels") {
        labels.clear();
        return checked([this](const json& value) { take_label(value); });
    }
    if (key == "notes") {
        notes.clear();
        return checked([this](const json& note) { take_note(note); });
    }
    if (key == "repairs") { // of version 1, which has no other notes
        repairs.clear();
        return checked([this](const json& text) {
            const std::string place = TreeJsonValues::element("repairs", repairs.size());
            repairs.push_back({tree::Note::Kind::kRepaired, "", values_.string(text, place), {}});
        });
    }
    if (key == "branch_systems") return indices_of(branch_systems);
    return key == "roots" ? indices_of(roots) : [](json& /*value*/) {};
}

JsonElements TreeJsonLists::taker_of(JsonPath list) {
    if (list.empty()) return {};
    const std::string& key = list.front();
    if (list.size() == 2 && key == "points") {
        coordinate_ = 0;
        return checked([this](const json& value) { take_coordinate(value); });
    }
    if (list.size() == 2 && key == "branches")
        return checked([this](const json& value) { vertices_.push_back(json_index(value)); });
    if (key == "voxel_mm" || key == "systems" || (key == "notes" && list.size() > 1)) return {};
    if (list.size() == 2 && key == "point_data") return data_of(point_data, key, list[1]);
    if (list.size() == 2 && key == "branch_data") return data_of(branch_data, key, list[1]);
    if (list.size() == 1) return whole_list(key);
    return [](json& /*value*/) {};
}

void TreeJsonLists::take_coordinate(const json& value) {
    if (!value.is_number())
        values_.refuse(TreeJsonValues::element(TreeJsonValues::element("points", points.size()), coordinate_),
                       "is not a number");
    if (coordinate_ < coordinates_.size()) coordinates_[coordinate_] = value.get<double>();
    ++coordinate_;
}

void TreeJsonLists::take_point(const json& row) {
    if (points.size() == kNoJsonIndex) values_.refuse("points", "are too many");
    if (!row.is_array() || coordinate_ != coordinates_.size())
        values_.refuse(TreeJsonValues::element("points", points.size()), "is not [x, y, z, radius]");
    points.push_back({{coordinates_[0], coordinates_[1], coordinates_[2]}, coordinates_[3]});
}

void TreeJsonLists::take_branch(const json& row) {
    if (!row.is_array() || vertices_.size() < (ends_.empty() ? 0 : ends_.back()) + 2)
        values_.refuse(TreeJsonValues::element("branches", ends_.size()),
                       "is not a list of at least two point indices");
    ends_.push_back(vertices_.size());
}

void TreeJsonLists::take_label(const json& value) {
    if (!value.is_number_integer() || value < std::numeric_limits<int>::min() ||
        value > std::numeric_limits<int>::max())
        values_.refuse(TreeJsonValues::element("labels", labels.size()), "is not a whole number of 32 bits");
    labels.push_back(value.get<int>());
}

void TreeJsonLists::take_note(const json& note) {
    const std::string place = TreeJsonValues::element("notes", notes.size());
    if (!note.is_object()) values_.refuse(place, "is not an object");
    const std::string kind = values_.string(note.value("kind", json()), place + ".kind");
    const auto* const known =
        std::ranges::find(kNoteKinds, kind, [](const auto& each) { return std::string(each.second); });
    if (known == std::end(kNoteKinds)) values_.refuse(place + ".kind", "is not assumed, repaired or suspect");
    tree::Note read{known->first,
                    values_.string(note.value("topic", json()), place + ".topic"),
                    values_.string(note.value("text", json()), place + ".text"),
                    {}};
    const auto vector = [&](const char* key) -> std::optional<glm::dvec3> {
        if (!note.contains(key)) return std::nullopt;
        const std::array<double, 3> at = values_.numbers<3>(note[key], place + "." + key, "[x, y, z]");
        return glm::dvec3(at[0], at[1], at[2]);
    };
    read.at = vector("at");
    read.outward = vector("outward");
    if (read.outward && !(std::abs(glm::length(*read.outward) - 1.0) < 1e-6))
        values_.refuse(place + ".outward", "is not of length 1");
    notes.push_back(std::move(read));
}

} // namespace ramus::io
