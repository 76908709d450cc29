#include "core/io/json_text.h"

#include "core/io/text_numbers.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace ramus::io {

namespace {

using nlohmann::json;

constexpr std::size_t kLargestJson = std::size_t{2} << 30;

// Approximate size of a value with GCC's library and glibc: its element in a list that grows by doubling, and the
// memory it points to.
constexpr std::size_t kValueBytes = 24, kTextBytes = 48, kListBytes = 64, kMemberBytes = 96;

class JsonBuilder : public nlohmann::json_sax<json> {
public:
    explicit JsonBuilder(const JsonLists& lists) : lists_(lists) {
        levels_.reserve(kDeepestJson + 1); // levels hold values under construction and must not move
    }

    struct Wrong {
        std::size_t byte = 0; // offset just after the error
        bool is_number = false;
        std::string token;
    };
    [[nodiscard]] const std::optional<Wrong>& wrong() const { return wrong_; }
    [[nodiscard]] json take_root() { return std::move(root_); }

    bool null() override { return add(json()); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t& /*token*/) override { return add(value); }
    bool string(string_t& value) override {
        bytes_ += kTextBytes + value.size();
        return add(std::move(value));
    }
    bool binary(binary_t& /*value*/) override { return false; } // JSON has none
    bool start_object(std::size_t /*unknown*/) override { return open(json::object(), {}); }
    bool key(string_t& name) override {
        keys_.back() = std::move(name);
        return true;
    }
    bool end_object() override { return close(); }
    bool start_array(std::size_t /*unknown*/) override {
        return open(json::array(), lists_ ? lists_(keys_) : JsonElements());
    }
    bool end_array() override { return close(); }
    bool parse_error(std::size_t position, const std::string& token, const json::exception& error) override {
        constexpr int kNumberOverflow = 406;
        wrong_ = {position, error.id == kNumberOverflow, token};
        return false;
    }

private:
    struct Level {
        json* value = nullptr;
        JsonElements take;
        std::size_t bytes = 0;  // bytes_ when the level began
        json element = nullptr; // under construction for the consumer
    };

    json* put(json value) {
        bytes_ += kValueBytes;
        if (levels_.empty()) return &(root_ = std::move(value));
        Level& level = levels_.back();
        if (level.take) return &(level.element = std::move(value));
        if (level.value->is_array()) return &level.value->get_ref<json::array_t&>().emplace_back(std::move(value));
        bytes_ += kMemberBytes + keys_.back().size();
        return &((*level.value)[keys_.back()] = std::move(value));
    }
    bool add(json value) {
        put(std::move(value));
        return hand_over();
    }
    bool open(json value, JsonElements take) {
        bytes_ += kListBytes;
        json* const place = put(std::move(value));
        levels_.push_back({place, std::move(take), bytes_, nullptr});
        keys_.emplace_back();
        return bytes_ <= kMostJsonBytes;
    }
    bool close() {
        levels_.pop_back();
        keys_.pop_back();
        return hand_over();
    }
    // Called when a value is complete.
    bool hand_over() {
        const bool few = bytes_ <= kMostJsonBytes;
        if (few && !levels_.empty() && levels_.back().take) {
            Level& level = levels_.back();
            level.take(level.element);
            level.element = nullptr;
            bytes_ = level.bytes;
        }
        return few;
    }

    const JsonLists& lists_;
    json root_;
    std::vector<Level> levels_;
    std::vector<std::string> keys_; // by level; "": a list
    std::size_t bytes_ = 0;
    std::optional<Wrong> wrong_;
};

class NamesOfJson : public nlohmann::json_sax<json> {
public:
    std::vector<std::string> names;

    bool null() override { return depth_ > 0; }
    bool boolean(bool /*value*/) override { return depth_ > 0; }
    bool number_integer(number_integer_t /*value*/) override { return depth_ > 0; }
    bool number_unsigned(number_unsigned_t /*value*/) override { return depth_ > 0; }
    bool number_float(number_float_t /*value*/, const string_t& /*token*/) override { return depth_ > 0; }
    bool string(string_t& /*value*/) override { return depth_ > 0; }
    bool binary(binary_t& /*value*/) override { return false; }
    bool start_object(std::size_t /*unknown*/) override { return ++depth_ <= kDeepestJson; }
    bool key(string_t& name) override {
        constexpr std::size_t kMostNames = 1000;
        if (depth_ == 1) names.push_back(std::move(name));
        return names.size() <= kMostNames;
    }
    bool end_object() override { return depth_-- > 0; }
    bool start_array(std::size_t /*unknown*/) override { return ++depth_ > 1 && depth_ <= kDeepestJson; }
    bool end_array() override { return depth_-- > 0; }
    bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                     const json::exception& /*error*/) override {
        return false;
    }

private:
    int depth_ = 0;
};

// The offset where the text nests too deep, found before it is parsed.
std::optional<std::size_t> beyond_deepest(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (quoted && c == '\\')
            ++at;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{') && ++depth > kDeepestJson)
            return at;
        else if (!quoted && (c == ']' || c == '}'))
            --depth;
    }
    return std::nullopt;
}

template <class Json> std::string printed(const Json& value, int indent) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string printed_json(const json& value, int indent) { return printed(value, indent); }
std::string printed_json(const nlohmann::ordered_json& value, int indent) { return printed(value, indent); }

Result<json> parsed_json(std::string_view text, const std::string& name, const JsonLists& lists) {
    if (text.size() > kLargestJson)
        return fail("the file is larger than " + std::to_string(kLargestJson >> 20) + " MiB", name,
                    "choose a smaller file");
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        return fail("the file is empty", name, "choose another file");
    const auto place = [&](std::size_t at) { return name + ":" + std::to_string(line_at(text, at)); };
    if (const auto deep = beyond_deepest(text))
        return fail("lists are nested deeper than " + std::to_string(kDeepestJson) + " levels", place(*deep),
                    "no format here does that; check the program that wrote it");
    JsonBuilder builder(lists);
    if (json::sax_parse(text, &builder)) return builder.take_root();
    const auto& wrong = builder.wrong();
    if (!wrong)
        return fail("its values would take more than " + std::to_string(kMostJsonBytes >> 20) + " MiB of memory", name,
                    "no file of this kind has as many; check the program that wrote it");
    const std::string where = place(wrong->byte == 0 ? 0 : wrong->byte - 1);
    if (wrong->is_number)
        return fail("the number " + wrong->token.substr(0, 40) + " is too large", where, "correct the number");
    return fail("this is not valid JSON", where, "edit the file there, or write it anew with `ramus convert`");
}

std::vector<std::string> json_names(std::istream& text) {
    NamesOfJson names;
    return json::sax_parse(text, &names) ? names.names : std::vector<std::string>();
}

} // namespace ramus::io
