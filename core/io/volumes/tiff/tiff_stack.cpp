#include "core/io/volumes/tiff/tiff_stack.h"

#include "core/base/printable.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStackAlone = "put the files of one stack into a folder of their own, one number for each slice";
constexpr std::size_t kMostStackFiles = 65'536;

// A file name as alternating text and numbers: "s", 1, "_z", 12, ".tif".
struct NumberedName {
    fs::path path;
    std::vector<std::string> texts; // one more than numbers
    std::vector<std::uint64_t> numbers;
};

NumberedName numbered_name(const fs::path& path) {
    NumberedName name{path, {""}, {}};
    const std::string text = path.filename().string();
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
        constexpr std::size_t kMostDigits = 18; // longer ones are text
        if (end == at || end - at > kMostDigits) {
            const std::size_t count = std::max<std::size_t>(end - at, 1);
            name.texts.back() += text.substr(at, count);
            at += count;
            continue;
        }
        name.numbers.push_back(std::stoull(text.substr(at, end - at)));
        name.texts.emplace_back();
        at = end;
    }
    return name;
}

Result<std::vector<NumberedName>> tiff_names_in(const fs::path& folder) {
    std::vector<NumberedName> names;
    std::error_code error;
    for (fs::directory_iterator each(folder.empty() ? "." : folder, error); !error && each != fs::directory_iterator();
         each.increment(error)) {
        std::error_code ignored;
        const fs::path name = each->path().filename();
        // A name that begins with a dot belongs to the system, as those that macOS adds.
        if (!names_tiff(name) || name.string().starts_with('.') || !each->is_regular_file(ignored)) continue;
        names.push_back(numbered_name(folder / name));
        if (names.size() > kMostStackFiles)
            return fail("it holds more than 65,536 TIFF files", folder.string(), "write them as one file or OME-Zarr");
    }
    if (error) return fail("cannot be listed: " + error.message(), folder.string(), "check its permissions");
    std::ranges::sort(names, {}, &NumberedName::path);
    return names;
}

// Sorts by the number at `at`, and fails if one is missing or repeated.
Result<std::vector<fs::path>> in_order(std::vector<NumberedName> names, std::size_t at) {
    std::ranges::stable_sort(names, {}, [&](const NumberedName& name) { return name.numbers[at]; });
    std::vector<fs::path> files;
    for (std::size_t n = 0; n < names.size(); ++n) {
        if (n > 0 && names[n].numbers[at] != names[n - 1].numbers[at] + 1) {
            const std::uint64_t before = names[n - 1].numbers[at], after = names[n].numbers[at];
            const std::string between =
                names[n - 1].path.filename().string() + " and " + names[n].path.filename().string();
            if (before == after)
                return fail("two files have the same number: " + printable(between),
                            names[n].path.parent_path().string(), kStackAlone);
            return fail("slice" +
                            (after - before > 2
                                 ? "s " + std::to_string(before + 1) + " to " + std::to_string(after - 1) + " are"
                                 : " " + std::to_string(before + 1) + " is") +
                            " missing between " + printable(between),
                        names[n].path.parent_path().string(), "copy all files of the stack, numbered without gaps");
        }
        files.push_back(names[n].path);
    }
    return files;
}

} // namespace

bool names_tiff(const fs::path& path) {
    const std::string extension = lower_case(path.extension().string());
    return extension == ".tif" || extension == ".tiff";
}

Result<std::vector<fs::path>> tiff_stack_in(const fs::path& folder) {
    RAMUS_TRY(names, tiff_names_in(folder));
    if (names.empty()) return fail("there is no TIFF file in this folder", folder.string(), "name a file");
    if (names.size() == 1) return std::vector{names.front().path};
    const NumberedName& first = names.front();
    std::optional<std::size_t> differs;
    for (const NumberedName& name : names) {
        if (name.texts != first.texts)
            return fail("its TIFF files are not one stack: " + printable(first.path.filename().string()) + ", " +
                            printable(name.path.filename().string()),
                        folder.string(), std::string("name one of the files, or ") + kStackAlone);
        for (std::size_t at = 0; at < first.numbers.size(); ++at) {
            if (name.numbers[at] == first.numbers[at]) continue;
            if (differs && *differs != at)
                return fail("the names of its TIFF files differ by several numbers: " +
                                printable(first.path.filename().string()) + ", " +
                                printable(name.path.filename().string()),
                            folder.string(), std::string("name one of the files, or ") + kStackAlone);
            differs = at;
        }
    }
    // The same numbers written in two ways: 1 and 01.
    return in_order(std::move(names), differs.value_or(first.numbers.empty() ? 0 : first.numbers.size() - 1));
}

Result<std::vector<fs::path>> tiff_stack_of(const fs::path& file) {
    RAMUS_TRY(names, tiff_names_in(file.parent_path()));
    const NumberedName self = numbered_name(file);
    std::vector<NumberedName> most;
    std::size_t most_at = 0;
    for (std::size_t at = 0; at < self.numbers.size(); ++at) {
        std::vector<NumberedName> stack;
        for (const NumberedName& name : names) {
            bool same = name.texts == self.texts;
            for (std::size_t n = 0; same && n < self.numbers.size(); ++n)
                same = n == at || name.numbers[n] == self.numbers[n];
            if (same) stack.push_back(name);
        }
        if (stack.size() > most.size()) most = std::move(stack), most_at = at;
    }
    if (most.size() < 2) return std::vector{file};
    return in_order(std::move(most), most_at);
}

} // namespace ramus::io
