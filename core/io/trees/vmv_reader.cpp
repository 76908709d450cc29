#include "core/io/text_numbers.h"
#include "core/io/trees/swc.h"
#include "core/io/trees/tree_data.h"
#include "core/io/trees/vmv.h"

#include <map>
#include <optional>
#include <set>
#include <unordered_map>

namespace ramus::io {

namespace {

constexpr const char* kVmvIncomplete = "the file is incomplete; get it again";

// "VERT_LIST" of "$VERT_LIST_BEGIN".
std::optional<std::string_view> vmv_block(std::string_view line, std::string_view ending) {
    if (!line.starts_with('$') || !line.ends_with(ending)) return std::nullopt;
    return line.substr(1, line.size() - 1 - ending.size());
}

class VmvReader {
public:
    explicit VmvReader(const TreeInput& input) : name_(input.name), lines_(input.text, input.name) {}

    Result<ImportedTree> read() {
        while (lines_.left() > 0) {
            line_ = lines_.line_number();
            const std::string_view line = trimmed(lines_.line());
            if (line.starts_with('#')) read_own_words(line);
            if (line.empty() || line.starts_with('#')) continue;
            if (auto good = read_line(line); !good) return tl::unexpected(good.error());
        }
        if (!block_.empty()) return fail("the file ends before $" + block_ + "_END", place(), kVmvIncomplete);
        for (const char* needed : {"VERT_LIST", "STRANDS_LIST"})
            if (!ended_.contains(needed))
                return fail("there is no block $" + std::string(needed) + "_BEGIN", name_, kVmvIncomplete);
        if (imported_.graph.edges.empty()) return fail("no strand connects two vertices", name_, "choose another file");
        for (const std::int64_t root : roots_)
            if (const auto found = index_of_.find(root); found != index_of_.end())
                imported_.graph.roots.push_back(found->second);
        tree::Graph& graph = imported_.graph;
        graph.point_data = std::move(data_).arrays(graph.points.size(), imported_);
        imported_.place_of = [name = name_, places = std::move(places_)](std::uint32_t point) {
            return name + ":" + std::to_string(places[point]);
        };
        return std::move(imported_);
    }

private:
    [[nodiscard]] std::string place() const { return name_ + ":" + std::to_string(line_); }

    void read_own_words(std::string_view line) {
        if (line.starts_with(kVmvColumns)) own_ = take_claims(line.substr(kVmvColumns.size()), imported_);
        if (!line.starts_with(kVmvRoots) || !own_) return;
        WordScanner words(line.substr(kVmvRoots.size()), name_);
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            if (const auto root = to_whole(word)) roots_.push_back(*root);
    }

    Result<void> read_line(std::string_view line) {
        if (const auto begun = vmv_block(line, "_BEGIN")) {
            if (!block_.empty())
                return fail(shown(line) + " stands where $" + block_ + "_END should", place(), kVmvIncomplete);
            block_ = *begun, rows_ = 0;
            return {};
        }
        if (const auto ended = vmv_block(line, "_END")) return end_block(line, *ended);
        ++rows_;
        if (block_ == "PARAM") return read_parameter(line);
        if (block_ == "VERT_LIST") return read_vertex(line);
        if (block_ == "STRANDS_LIST") return read_strand(line);
        if (block_.empty()) return fail("found " + shown(line) + " outside of all blocks", place(), "remove the line");
        return {};
    }

    Result<void> end_block(std::string_view line, std::string_view ended) {
        if (ended != block_) return fail("nothing begins that " + shown(line) + " ends", place(), kVmvIncomplete);
        const auto declared = block_ == "VERT_LIST"      ? parameters_.find("NUM_VERTS")
                              : block_ == "STRANDS_LIST" ? parameters_.find("NUM_STRANDS")
                                                         : parameters_.end();
        if (declared != parameters_.end() && declared->second != rows_)
            return fail(declared->first + " is " + std::to_string(declared->second) + ", but there are " +
                            counted(static_cast<std::size_t>(rows_), "line"),
                        place(), "the file is incomplete, or " + declared->first + " is wrong");
        ended_.insert(block_);
        block_.clear();
        return {};
    }

    Result<void> read_parameter(std::string_view line) {
        if (line.starts_with('$')) line.remove_prefix(1);
        WordScanner words(line, name_);
        const std::string key(words.next());
        if (key != "NUM_VERTS" && key != "NUM_STRANDS" && key != "NUM_ATTRIB_PER_VERT") return {};
        const std::string_view word = words.next();
        const auto value = to_whole(word);
        if (!value || *value < 0)
            return fail(key + " " + shown(word) + " is no count", place(), "write a whole number from 0");
        if (key == "NUM_ATTRIB_PER_VERT" && *value < 4)
            return fail("the vertices have " + std::to_string(*value) + " attributes", place(),
                        "a tree needs x, y, z and the radius");
        parameters_[key] = *value;
        return {};
    }

    Result<void> read_vertex(std::string_view line) {
        constexpr const char* kVmvLayout = "a line is: index x y z radius";
        WordScanner words(line, name_);
        const std::string_view word = words.next();
        const auto index = to_whole(word);
        if (!index) return fail("the index " + shown(word) + " is not a whole number", place(), kVmvLayout);
        double values[4] = {};
        for (int c = 0; c < 4; ++c) {
            const std::string_view text = words.next();
            constexpr const char* kNames[4] = {"x", "y", "z", "radius"};
            const auto value = to_real(text);
            if (text.empty()) return fail("the " + std::string(kNames[c]) + " is missing", place(), kVmvLayout);
            if (!value)
                return fail("the " + std::string(kNames[c]) + " " + shown(text) + " is not a number", place(),
                            kVmvLayout);
            values[c] = *value;
        }
        const auto number = static_cast<std::uint32_t>(places_.size());
        if (!index_of_.emplace(*index, number).second)
            return fail("the index " + std::to_string(*index) + " is there twice", place(),
                        "give each vertex an index of its own");
        imported_.graph.points.push_back({{values[0], values[1], values[2]}, values[3]});
        std::size_t attribute = 4; // the format has no names for values after the radius
        for (std::string_view more = words.next(); !more.empty(); more = words.next()) {
            const auto value = data_value(more);
            if (!value) return fail("the attribute " + shown(more) + " is not a number", place(), kVmvLayout);
            data_.set(data_.array("attribute_" + std::to_string(++attribute)), number, *value);
        }
        places_.push_back(line_);
        return {};
    }

    Result<void> read_strand(std::string_view line) {
        WordScanner words(line, name_);
        if (!to_whole(words.next()))
            return fail("the strand has no whole number as its name", place(), "a line is: id vertex vertex ...");
        std::optional<std::uint32_t> before;
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const auto index = to_whole(word);
            const auto found = index ? index_of_.find(*index) : index_of_.end();
            if (found == index_of_.end())
                return fail("the strand names vertex " + shown(word) + ", which is not listed", place(),
                            "correct the strand, or list the vertex above");
            if (before) imported_.graph.edges.emplace_back(*before, found->second);
            before = found->second;
        }
        return {};
    }

    const std::string& name_;
    WordScanner lines_;
    std::size_t line_ = 1;
    bool own_ = false;  // ramus wrote the file
    std::string block_; // that is open: "VERT_LIST"
    std::int64_t rows_ = 0;
    std::map<std::string, std::int64_t> parameters_;
    std::set<std::string> ended_; // blocks
    std::unordered_map<std::int64_t, std::uint32_t> index_of_;
    std::vector<std::int64_t> roots_;
    SparseData data_;                 // of points
    std::vector<std::size_t> places_; // by point: its line
    ImportedTree imported_;
};

} // namespace

bool is_vmv(std::string_view head) {
    return head.find("$PARAM_BEGIN") != std::string_view::npos ||
           head.find("$VERT_LIST_BEGIN") != std::string_view::npos;
}

Result<ImportedTree> parse_vmv(const TreeInput& input) { return VmvReader(input).read(); }

} // namespace ramus::io
