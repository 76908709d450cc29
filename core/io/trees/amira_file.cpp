#include "core/io/trees/amira_file.h"

#include "core/base/words.h"
#include "core/io/inflate.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ramus::io {

namespace {

constexpr std::string_view kAmiraBlanks = " \t\r\n,";
constexpr std::string_view kAmiraSigns = "{}[]()@=";
constexpr std::size_t kMostAmiraArrays = 1000; // because each lookup is linear
constexpr const char* kAmiraIncomplete = "the file is incomplete or damaged; get it again";

std::optional<NumberType> amira_type(std::string_view word) {
    constexpr std::pair<std::string_view, NumberType> kTypes[] = {
        {"float", NumberType::kFloat},   {"double", NumberType::kDouble}, {"int", NumberType::kInt32},
        {"byte", NumberType::kUInt8},    {"char", NumberType::kInt8},     {"short", NumberType::kInt16},
        {"ushort", NumberType::kUInt16}, {"uint", NumberType::kUInt32},   {"long", NumberType::kInt64}};
    return paired(kTypes, word);
}

class AmiraHeader {
public:
    AmiraHeader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    Result<AmiraFile> read() {
        const std::string_view first = text_.substr(0, text_.find('\n'));
        file_.binary = first.find("BINARY") != std::string_view::npos;
        if (first.find("HyperSurface") != std::string_view::npos) return no_graph("a surface of triangles (HxSurface)");
        if (first.find("LITTLE-ENDIAN") != std::string_view::npos) file_.order = std::endian::little;
        for (std::string_view word = next(); !word.empty(); word = next()) {
            if (word == "@" && begins_line(at_ - 1)) {
                at_ -= 1;
                break; // the data
            }
            if (auto good = read_statement(word); !good) return tl::unexpected(good.error());
        }
        if (!file_.counts.contains("EDGE"))
            for (const auto& [defined, what] : kAmiraKinds)
                if (file_.counts.contains(std::string(defined))) return no_graph(std::string(what));
        if (auto good = find_data(); !good) return tl::unexpected(good.error());
        return std::move(file_);
    }

private:
    // Other kinds of Amira files, by the words that they define.
    static constexpr std::pair<std::string_view, std::string_view> kAmiraKinds[] = {
        {"Lattice", "a lattice of voxels (labels or grey values)"},
        {"Tetrahedra", "a tetrahedral grid (HxTetraGrid)"},
        {"Hexahedra", "a hexahedral grid (HxHexaGrid)"},
        {"Triangles", "a surface of triangles"},
        {"Lines", "a set of lines (HxLineSet)"},
        {"Markers", "a set of landmarks"},
        {"Points", "a cluster of points"},
        {"Nodes", "a grid of nodes"}};
    [[nodiscard]] tl::unexpected<Error> no_graph(const std::string& what) const {
        return fail("this Amira file holds " + what + ", not a tree", name_,
                    what.starts_with("a lattice")
                        ? "save the labels as NIfTI or NRRD, or trace them and save the HxSpatialGraph"
                        : "a tree needs a HxSpatialGraph");
    }

    [[nodiscard]] std::string place() const { return name_ + ":" + std::to_string(line_at(text_, at_)); }

    [[nodiscard]] bool begins_line(std::size_t at) const {
        const std::size_t before = text_.find_last_not_of(" \t", at == 0 ? at : at - 1);
        return at == 0 || before == std::string_view::npos || text_[before] == '\n';
    }

    // The next word, quoted text (with its quotes) or sign; empty at the end. Skips comments.
    std::string_view next() {
        at_ = std::min(text_.find_first_not_of(kAmiraBlanks, at_), text_.size());
        if (at_ == text_.size()) return {};
        const std::size_t begin = at_;
        if (text_[at_] == '#') {
            at_ = std::min(text_.find('\n', at_), text_.size());
            return next_after_comments();
        }
        if (text_[at_] == '"')
            at_ = std::min(text_.find('"', at_ + 1), text_.size() - 1) + 1;
        else if (kAmiraSigns.find(text_[at_]) != std::string_view::npos)
            ++at_;
        else
            while (at_ < text_.size() && (kAmiraBlanks.find(text_[at_]) == std::string_view::npos &&
                                          kAmiraSigns.find(text_[at_]) == std::string_view::npos))
                ++at_;
        return text_.substr(begin, at_ - begin);
    }
    std::string_view next_after_comments() {
        while (true) {
            at_ = std::min(text_.find_first_not_of(kAmiraBlanks, at_), text_.size());
            if (at_ == text_.size() || text_[at_] != '#') return next();
            at_ = std::min(text_.find('\n', at_), text_.size());
        }
    }

    bool take(std::string_view word) {
        const std::size_t before = at_;
        if (next() == word) return true;
        at_ = before;
        return false;
    }

    Result<std::uint64_t> count(const std::string& what) {
        const std::string_view word = next();
        const auto value = to_whole(word);
        if (!value || *value < 0) return fail(what + " " + shown(word) + " is no count", place(), kAmiraIncomplete);
        return static_cast<std::uint64_t>(*value);
    }

    Result<void> read_statement(std::string_view word) {
        if (word == "define") {
            const std::string what(next());
            RAMUS_TRY(number, count("the number of " + what));
            file_.counts[what] = number;
            return {};
        }
        if (!take("{")) return {}; // a kind of element that trees do not have
        if (word == "Parameters") return read_parameters();
        return read_declaration(std::string(word));
    }

    Result<void> read_parameters() {
        std::vector<std::string> path;
        std::string key;
        for (std::string_view word = next(); !word.empty(); word = next()) {
            if (word == "{") {
                path.push_back(key);
            } else if (word == "}") {
                if (path.empty()) return {};
                path.pop_back();
            } else if (word.starts_with('"')) {
                const std::string value(word.substr(1, word.size() - std::min<std::size_t>(word.size(), 2)));
                if (path.empty() && key == "ContentType") file_.content_type = value;
                if (path == std::vector<std::string>{"Units"} && key == "Coordinates") file_.unit = value;
            }
            key = word;
        }
        return fail("the header ends inside of Parameters", place(), kAmiraIncomplete);
    }

    // "VERTEX { float[3] VertexCoordinates } @1", from the text after the bracket.
    Result<void> read_declaration(const std::string& of) {
        AmiraArray array;
        array.of = of;
        const std::string type(next());
        if (take("[")) {
            RAMUS_TRY(components, count("the number of components"));
            array.components = components;
            if (components == 0 || components > 64 || !take("]"))
                return fail("an array of " + of + " has " + std::to_string(components) + " components", place(),
                            kAmiraIncomplete);
        }
        array.name = next();
        const auto known = amira_type(type);
        if (!take("}")) return fail("found no } behind " + shown(array.name), place(), kAmiraIncomplete);
        static_cast<void>(take("="));
        if (!take("@")) return {}; // without data
        RAMUS_TRY(mark, count("the mark"));
        array.mark = static_cast<std::int64_t>(mark);
        if (!known)
            return fail(array.name + " has numbers of type " + shown(type), place(), "they are of int, float, double");
        array.type = *known;
        if (take("(")) {
            array.codec = next();
            if (!take(")")) {
                RAMUS_TRY(size, count("the size of " + array.name));
                array.coded_size = size;
                static_cast<void>(take(")"));
            }
        }
        if (file_.arrays.size() == kMostAmiraArrays)
            return fail("the file declares more than " + std::to_string(kMostAmiraArrays) + " arrays", place(),
                        kAmiraIncomplete);
        file_.arrays.push_back(std::move(array));
        return {};
    }

    // The bytes of an array in a binary file, limited to avoid an overflow.
    Result<std::uint64_t> size_in_file(const AmiraArray& array) {
        if (!array.codec.empty()) return array.coded_size;
        const auto counted_things = file_.counts.find(array.of);
        if (counted_things == file_.counts.end())
            return fail("the number of " + array.of + " is not defined", name_, "add define " + array.of);
        return std::min<std::uint64_t>(counted_things->second, text_.size() + 1) * array.components *
               size_of(array.type);
    }

    Result<void> find_data() {
        while (true) {
            at_ = std::min(text_.find_first_not_of(kAmiraBlanks, at_), text_.size());
            if (at_ == text_.size()) return {};
            if (text_[at_] != '@')
                return fail("found " + shown(text_.substr(at_, 12)) + " where an array should begin", place(),
                            kAmiraIncomplete);
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            const std::string_view line = text_.substr(at_ + 1, end - at_ - 1);
            const auto mark = to_whole(trimmed(line.substr(0, line.find('#')))); // a comment may follow
            const auto array =
                std::ranges::find_if(file_.arrays, [&](const AmiraArray& a) { return mark && a.mark == *mark; });
            if (array == file_.arrays.end())
                return fail(shown(text_.substr(at_, end - at_)) + " is the mark of no array", place(),
                            kAmiraIncomplete);
            if (array->is_there)
                return fail("@" + std::to_string(*mark) + " is there twice", place(), kAmiraIncomplete);
            at_ = std::min(end + 1, text_.size());
            array->is_there = true;
            if (!file_.binary) {
                const std::size_t behind = std::min(text_.find('@', at_), text_.size());
                array->data = text_.substr(at_, behind - at_);
                at_ = behind;
                continue;
            }
            RAMUS_TRY(size, size_in_file(*array));
            if (size > text_.size() - at_)
                return fail(array->name + " should have " + std::to_string(size) + " bytes, there are " +
                                std::to_string(text_.size() - at_),
                            name_, kAmiraIncomplete);
            array->data = text_.substr(at_, size);
            at_ += size;
        }
    }

    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
    AmiraFile file_;
};

// Run-length encoding: a byte is the number of repetitions of the next byte, or, with its highest bit set, the number
// of literal bytes that follow.
Result<std::string> amira_runs(std::string_view bytes, std::uint64_t size, const std::string& where) {
    std::string plain;
    for (std::size_t at = 0; at < bytes.size();) {
        const auto control = static_cast<unsigned char>(bytes[at++]);
        const std::size_t count = control & 127U, taken = control < 128 ? 1 : count;
        if (count == 0 || taken > bytes.size() - at || count > size - plain.size())
            return fail("the compressed data is damaged", where, "get the file again");
        if (control < 128)
            plain.append(count, bytes[at]);
        else
            plain.append(bytes.substr(at, count));
        at += taken;
    }
    return plain;
}

tl::unexpected<Error> wrong_count(const AmiraArray& array, const std::string& found, std::uint64_t things,
                                  const std::string& where) {
    return fail(array.name + " (@" + std::to_string(array.mark) + ") has " + found + " numbers, " +
                    std::to_string(things) + " " + array.of + " of " + std::to_string(array.components) +
                    " are declared",
                where, "the file is incomplete, or \"define " + array.of + "\" is wrong");
}

} // namespace

const AmiraArray* AmiraFile::find(std::string_view of, std::string_view name) const {
    for (const AmiraArray& array : arrays)
        if (array.of == of && array.name == name) return &array;
    return nullptr;
}

Result<AmiraFile> amira_file(std::string_view text, const std::string& name) { return AmiraHeader(text, name).read(); }

Result<std::vector<double>> amira_numbers(const AmiraFile& file, const AmiraArray& array, std::string_view text,
                                          const std::string& name) {
    const auto declared = file.counts.find(array.of);
    if (declared == file.counts.end())
        return fail("the number of " + array.of + " is not defined", name, "add define " + array.of);
    const std::uint64_t things = declared->second;
    const auto offset = static_cast<std::size_t>(array.data.data() - text.data());
    const auto place = [&](std::size_t at) {
        return file.binary ? name : name + ":" + std::to_string(line_at(text, offset + at));
    };
    // Each number takes at least a byte, or if compressed a fraction of a byte.
    const std::uint64_t most = array.codec.empty() ? array.data.size() : inflation_limit(array.data.size());
    if (things > most / array.components) return wrong_count(array, "fewer", things, place(0));
    const std::uint64_t count = things * array.components;
    if (file.binary) {
        const std::uint64_t size = count * size_of(array.type);
        if (array.codec.empty()) return numbers_in(array.data, array.type, file.order);
        if (array.codec != "HxZip" && array.codec != "HxByteRLE")
            return fail(array.name + " is compressed by " + shown(array.codec), name,
                        "write the file without compression");
        RAMUS_TRY(bytes,
                  array.codec == "HxZip" ? inflated(array.data, size, name) : amira_runs(array.data, size, name));
        if (bytes.size() != size)
            return wrong_count(array, std::to_string(bytes.size() / size_of(array.type)), things, name);
        return numbers_in(bytes, array.type, file.order);
    }
    std::vector<double> values;
    WordScanner words(array.data, name);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const auto at = static_cast<std::size_t>(word.data() - array.data.data());
        if (word.starts_with('#')) {
            static_cast<void>(words.line());
            continue;
        }
        const auto value = to_real(word);
        if (!value) return fail(shown(word) + " in " + array.name + " is not a number", place(at), kAmiraIncomplete);
        if (values.size() == count) return wrong_count(array, "more", things, place(at));
        values.push_back(*value);
    }
    if (values.size() != count) return wrong_count(array, std::to_string(values.size()), things, place(0));
    return values;
}

} // namespace ramus::io
