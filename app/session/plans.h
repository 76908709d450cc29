// Plans of an operation. A session has one or more. The current one is what the marks hold: its cuts and resections are
// those that are seen and changed; the others wait here.
#pragma once

#include "app/session/objects.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct Marks;

struct OperationPlan {
    std::string name;
    std::vector<std::pair<int, double>> cuts; // as Marks::cuts
    std::vector<Resection> resections;        // of plans that wait without ids
    bool operator==(const OperationPlan&) const = default;
};

struct Plans {
    std::string name = "A";                // of the current plan
    std::size_t place = 0;                 // of the current plan among all, from 0
    std::vector<OperationPlan> others;     // in order, without the current one
    std::optional<std::size_t> compared{}; // the plan that is shown next to the current one
    [[nodiscard]] std::size_t count() const { return others.size() + 1; }
    bool operator==(const Plans&) const = default;
};

[[nodiscard]] std::vector<OperationPlan> all_plans(const Marks& marks); // in order, with the current one
[[nodiscard]] std::string& name_of_plan(Marks& marks, std::size_t plan);
// Adds a copy of the current plan behind all others, which becomes the current one.
void copy_plan(Marks& marks, std::string name);
void use_plan(Marks& marks, std::size_t plan);
void remove_plan(Marks& marks, std::size_t plan); // not the only one

} // namespace ramus::app
