// The figures of an organ as words, for panels and reports.
#pragma once

#include "app/assets/operation.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct OrganFact {
    std::string label;
    std::optional<double> volume{};                                // mm3, or cubed units of the mask
    std::optional<double> percent{};                               // of what the label or `help` names
    std::optional<double> area{};                                  // mm2
    std::optional<double> length{};                                // mm
    std::string help{};                                            // what it means, without a full stop
    [[nodiscard]] std::string value(const Lengths& lengths) const; // "850 ml, 62 %"; without numbers: "none"
};

// The organ and its functional volume; of an operation also what is removed, what remains, what each system loses and
// the margins of lesions, and with the patient's size the remnant's share of it. Numbers only: limits are quoted, not
// judged.
[[nodiscard]] std::vector<OrganFact> organ_facts(const Operation& operation, const Marks& marks);

// A figure of all plans of a session.
struct PlanFigure {
    std::string label, help;
    std::vector<std::string> values; // by plan; empty: the plan has no such figure, or its operation is not made
};
// In the order in which the plans have them.
[[nodiscard]] std::vector<PlanFigure> plan_figures(const Assets& assets, const Marks& marks, OperationOf which);

} // namespace ramus::app
