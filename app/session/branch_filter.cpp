#include "app/session/branch_filter.h"

#include "app/session/systems.h"
#include "core/base/words.h"
#include "core/io/file_format.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ramus::app {

namespace {

constexpr std::pair<std::string_view, BranchProperty> kProperties[] = {
    {"normal", BranchProperty::kNormal},       {"highlighted", BranchProperty::kHighlighted},
    {"defocused", BranchProperty::kDefocused}, {"hidden", BranchProperty::kHidden},
    {"selected", BranchProperty::kSelected},   {"leaf", BranchProperty::kLeaf},
    {"named", BranchProperty::kNamed},
};

constexpr std::pair<std::string_view, Relation> kComparisons[] = {
    {"<=", Relation::kLessOrEqual},
    {"<", Relation::kLess},
    {">=", Relation::kGreaterOrEqual},
    {">", Relation::kGreater},
    {"==", Relation::kEqual},
    {"!=", Relation::kNotEqual},
    {"\xE2\x89\xA4", Relation::kLessOrEqual},
    {"\xE2\x89\xA5", Relation::kGreaterOrEqual},
    {"=", Relation::kEqual},
};

std::optional<double> number(std::string_view text) {
    const auto value = parsed<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

// "d, len, gen or id"
std::string quantity_names() {
    std::vector<std::string_view> names;
    for (const QuantityRow& row : quantities())
        if (!row.filter_names.empty()) names.push_back(row.filter_names.front());
    return io::listed(names);
}

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Result<BranchFilter> parse() {
        BranchFilter filter;
        for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
            RAMUS_TRY(condition, next());
            filter.push_back(std::move(condition));
        }
        return filter;
    }

private:
    void skip_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == ',')) ++at_;
    }
    std::optional<Relation> take_comparison() {
        for (const auto& [spelling, comparison] : kComparisons)
            if (text_.substr(at_).starts_with(spelling)) {
                at_ += spelling.size();
                return comparison;
            }
        return {};
    }
    [[nodiscard]] bool at_comparison() const {
        return std::ranges::any_of(kComparisons,
                                   [&](const auto& entry) { return text_.substr(at_).starts_with(entry.first); });
    }
    std::string_view take_word() {
        const std::size_t from = at_;
        while (at_ < text_.size() && text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != ',' &&
               text_[at_] != '"' && !at_comparison())
            ++at_;
        return text_.substr(from, at_ - from);
    }

    Result<BranchCondition> next() {
        if (text_[at_] == '"') {
            RAMUS_TRY(quoted, take_quoted());
            return BranchCondition{.text = quoted};
        }
        const std::string word = io::lower_case(take_word());
        const std::size_t behind = at_;
        skip_blanks();
        if (const auto comparison = take_comparison()) return quantity_condition(word, *comparison);
        at_ = behind;
        if (word.starts_with("is:")) {
            const auto property = paired(kProperties, word.substr(3));
            if (!property) return fail("is: takes hidden, selected, highlighted, defocused, normal, leaf or named");
            return BranchCondition{.kind = BranchCondition::Kind::kProperty, .property = *property};
        }
        if (constexpr std::string_view kSystem = "system:"; word.starts_with(kSystem)) {
            std::string name = word.substr(kSystem.size());
            if (name.empty() && at_ < text_.size() && text_[at_] == '"') {
                RAMUS_TRY(quoted, take_quoted());
                name = quoted;
            }
            if (name.empty()) return fail("system: takes the name of a system, or a part of it");
            return BranchCondition{.kind = BranchCondition::Kind::kSystem, .text = name};
        }
        return BranchCondition{.text = word};
    }

    // Parses text in quotes.
    Result<std::string> take_quoted() {
        const std::size_t end = text_.find('"', at_ + 1);
        if (end == std::string_view::npos) return fail("a quote is not closed");
        std::string quoted = io::lower_case(text_.substr(at_ + 1, end - at_ - 1));
        at_ = end + 1;
        return quoted;
    }

    Result<BranchCondition> quantity_condition(const std::string& word, Relation comparison) {
        if (word.empty()) return fail("what shall be compared?", {}, quantity_names());
        const auto quantity = filtered_quantity(word);
        if (!quantity) return fail("\"" + word + "\" is not known", {}, quantity_names());
        skip_blanks();
        std::string value = io::lower_case(take_word());
        const auto is_unit = [](std::string_view unit) {
            return unit == "mm" || unit == "mm3" || unit == "mm\xC2\xB3";
        };
        const std::size_t letters = value.find('m');
        if (letters != std::string::npos && letters > 0 && is_unit(std::string_view(value).substr(letters)))
            value.resize(letters);
        else {
            const std::size_t behind = at_;
            skip_blanks();
            if (!is_unit(io::lower_case(take_word()))) at_ = behind;
        }
        const auto parsed = number(value);
        if (!parsed) return fail(value.empty() ? word + ": a number is missing" : "\"" + value + "\" is not a number");
        return BranchCondition{.kind = BranchCondition::Kind::kQuantity,
                               .quantity = *quantity,
                               .comparison = comparison,
                               .value = *parsed};
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

// Numbers are shown with three digits; values that look equal compare equal.
constexpr double kShownPrecision = 5e-4;

bool holds(double value, Relation comparison, double wanted, double precision) {
    const bool equal = std::abs(value - wanted) <= precision * std::abs(wanted);
    switch (comparison) {
    case Relation::kLess:
        return value < wanted;
    case Relation::kLessOrEqual:
        return value <= wanted || equal;
    case Relation::kGreater:
        return value > wanted;
    case Relation::kGreaterOrEqual:
        return value >= wanted || equal;
    case Relation::kEqual:
        return equal;
    case Relation::kNotEqual:
        return !equal;
    }
    return false;
}

bool has(BranchProperty property, const tree::VesselTree& tree, const Marks& marks, int id, int source) {
    switch (property) {
    case BranchProperty::kNormal:
    case BranchProperty::kHighlighted:
    case BranchProperty::kDefocused:
    case BranchProperty::kHidden:
        return state_of(marks, id) == static_cast<tree::BranchState>(property);
    case BranchProperty::kSelected:
        return is_selected(marks, id);
    case BranchProperty::kLeaf:
        return tree.branches[static_cast<std::size_t>(id)].children.empty();
    case BranchProperty::kNamed:
        return source != tree::kNoBranch;
    }
    return false;
}

} // namespace

Result<BranchFilter> parse_branch_filter(std::string_view text) { return Parser(text).parse(); }

std::vector<int> branches_passing(const BranchFilter& filter, const tree::VesselTree& tree, const TreeFacts& facts,
                                  const Marks& marks) {
    const std::vector<int> sources = label_sources(facts.dependency, marks);
    std::map<int, std::string> labels; // lower case
    for (const auto& [id, name] : marks.names) labels.emplace(id, io::lower_case(name));
    std::vector<std::string> systems; // likewise
    for (int system = 0; system < static_cast<int>(tree.systems.size()); ++system)
        systems.push_back(io::lower_case(system_name(systems_of(tree, marks), system)));
    const auto in_system = [&](int id, const std::string& text) {
        const auto system = static_cast<std::size_t>(tree.branches[static_cast<std::size_t>(id)].system);
        return system < systems.size() && systems[system].find(text) != std::string::npos;
    };
    const auto passes = [&](const BranchCondition& condition, int id) {
        const int source = sources[static_cast<std::size_t>(id)];
        switch (condition.kind) {
        case BranchCondition::Kind::kQuantity: {
            const double value = value_of(condition.quantity, tree, facts, id);
            return holds(value, condition.comparison, condition.value,
                         row_of(condition.quantity).whole ? 0.0 : kShownPrecision);
        }
        case BranchCondition::Kind::kProperty:
            return has(condition.property, tree, marks, id, source);
        case BranchCondition::Kind::kText:
            return std::to_string(id) == condition.text || in_system(id, condition.text) ||
                   (source != tree::kNoBranch && labels.at(source).find(condition.text) != std::string::npos);
        case BranchCondition::Kind::kSystem:
            return in_system(id, condition.text);
        }
        return false;
    };
    return branches_where(tree.branches.size(), [&](std::size_t id) {
        return std::ranges::all_of(filter, [&](const auto& each) { return passes(each, static_cast<int>(id)); });
    });
}

} // namespace ramus::app
