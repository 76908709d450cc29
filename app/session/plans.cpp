#include "app/session/plans.h"

#include "app/session/session.h"

#include <algorithm>

namespace ramus::app {

namespace {

// Makes `plan` of `all` the current one. The compared plan stays, unless it is this one or the last of all.
void put_plans(Marks& marks, std::vector<OperationPlan> all, std::size_t plan) {
    auto& compared = marks.plans.compared;
    if (compared && (*compared == plan || *compared >= all.size())) compared.reset();
    OperationPlan& current = all[plan];
    marks.plans.name = std::move(current.name);
    marks.plans.place = plan;
    marks.cuts = std::move(current.cuts);
    marks.resections = std::move(current.resections);
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(plan));
    for (OperationPlan& other : all)
        for (Resection& resection : other.resections) resection.id = kNoObject;
    marks.plans.others = std::move(all);
    for (Resection& resection : marks.resections) resection.id = kNoObject;
    number_objects(marks);
}

} // namespace

std::vector<OperationPlan> all_plans(const Marks& marks) {
    std::vector<OperationPlan> all = marks.plans.others;
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(std::min(marks.plans.place, all.size())),
               {marks.plans.name, marks.cuts, marks.resections});
    return all;
}

std::string& name_of_plan(Marks& marks, std::size_t plan) {
    Plans& plans = marks.plans;
    return plan == plans.place ? plans.name : plans.others[plan < plans.place ? plan : plan - 1].name;
}

void copy_plan(Marks& marks, std::string name) {
    std::vector<OperationPlan> all = all_plans(marks);
    all.push_back({std::move(name), marks.cuts, marks.resections});
    const std::size_t last = all.size() - 1;
    put_plans(marks, std::move(all), last);
}

void use_plan(Marks& marks, std::size_t plan) {
    if (marks.plans.compared == plan) marks.plans.compared = marks.plans.place; // both stay in the picture
    put_plans(marks, all_plans(marks), plan);
}

void remove_plan(Marks& marks, std::size_t plan) {
    std::vector<OperationPlan> all = all_plans(marks);
    const std::size_t current = std::min(marks.plans.place, all.size() - 1);
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(plan));
    const std::size_t next = current > plan || current == all.size() ? current - 1 : current;
    auto& compared = marks.plans.compared;
    if (compared == plan)
        compared.reset();
    else if (compared && *compared > plan)
        --*compared;
    put_plans(marks, std::move(all), next);
}

} // namespace ramus::app
