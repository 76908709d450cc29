#include "app/commands/cohort_cases.h"

#include "app/session/checksum.h"
#include "app/session/numbers.h"
#include "app/storage/opening_files.h"
#include "core/base/printable.h"
#include "core/io/checksum.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/recognise.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace ramus::app {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNoCase = "no vessel tree or mask";

// Extensions of files of many kinds: the content decides whether there is a tree in them. A description beside a mask,
// as sub-01.json is for sub-01.nii.gz, is no case.
bool says_little(const fs::path& path) {
    static const std::set<std::string> shared = {".json", ".csv", ".xml"};
    return shared.contains(io::lower_case(io::without_gz(path).extension().string()));
}

bool is_dicom_format(const io::Recognised& found) { return found.volume != nullptr && found.volume->name == "DICOM"; }

// Why a file is no case. Empty: it is one.
std::string why_skipped(const fs::path& path, const io::Recognised& found) {
    if (found.volume != nullptr)
        return io::is_read(*found.volume) ? "" : "a " + std::string(found.volume->name) + ", which is not read";
    if (found.tree == nullptr) return found.mesh != nullptr ? "a mesh" : std::string(kNoCase);
    if (is_session_file(path)) return "a session; its tree is a case of its own";
    if (found.mesh != nullptr && io::is_mesh(path)) return "a mesh";
    const bool likely = found.tree->has_signature != nullptr && found.tree->has_signature(io::head_of(path));
    return says_little(path) && !likely ? std::string(kNoCase) : "";
}

std::string without_extension(const fs::path& relative, const io::Recognised& found) {
    const fs::path plain = io::without_gz(relative);
    const io::FileFormat& format = found.volume != nullptr ? static_cast<const io::FileFormat&>(*found.volume)
                                                           : static_cast<const io::FileFormat&>(*found.tree);
    // NIfTI's ".nii.gz" is an extension of its own.
    const std::size_t length = std::max(io::extension_length(plain, format), plain.extension().string().size());
    const std::string text = plain.string();
    return text.substr(0, text.size() - length);
}

// A word that every file system, shell and page takes as it is. Names that lose a letter get a checksum.
std::string folder_word(const std::string& name) {
    constexpr std::size_t kLongest = 64;
    constexpr std::string_view kOthers = "._-";
    std::string word;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        word += plain || kOthers.find(c) != std::string_view::npos ? c : '_';
    }
    word = word.substr(0, kLongest);
    if (word.front() == '.' || word.front() == '-') word.front() = '_';
    return word == name ? word : word + "-" + Checksum().add(name).text().substr(0, 8);
}

// Collects the files below a folder.
class Walk {
public:
    explicit Walk(const fs::path& root) : root_(root) {}

    Result<FoundCases> run() {
        std::vector<fs::path> files;
        std::error_code error;
        for (fs::recursive_directory_iterator at(root_, error), end; !error && at != end; at.increment(error)) {
            std::error_code ignored;
            const bool hidden = at->path().filename().string().starts_with(".");
            if (at->is_directory(ignored)) {
                if (hidden) skip(at->path(), "hidden"), at.disable_recursion_pending();
            } else if (hidden) {
                skip(at->path(), "hidden");
            } else if (at->is_regular_file(ignored)) {
                files.push_back(at->path());
            } else {
                skip(at->path(), "no regular file");
            }
        }
        if (error)
            return fail("the folder cannot be read: " + error.message(), root_.string(), "check its permissions");
        std::ranges::sort(files);
        for (const fs::path& file : files)
            if (auto taken = take(file); !taken) return tl::unexpected(taken.error());
        drop_series();
        if (found_.cases.empty())
            return fail("there is no vessel tree and no mask in this folder", root_.string(),
                        "trees are " + io::readable_tree_extensions() + ", masks " + io::readable_volume_extensions());
        std::ranges::sort(found_.cases, {}, &CohortCase::name);
        std::ranges::sort(found_.skipped, {}, &SkippedFile::path);
        return std::move(found_);
    }

private:
    [[nodiscard]] std::string below(const fs::path& path) const { return path.lexically_relative(root_).string(); }
    void skip(const fs::path& path, std::string reason) { found_.skipped.push_back({below(path), std::move(reason)}); }

    Result<void> take(const fs::path& file) {
        if (part_of_others_.contains(file)) return {};
        const std::string relative = below(file);
        if (printable(relative) != relative) {
            skip(file, "its name has control characters or is not UTF-8; rename it");
            return {};
        }
        const io::Recognised format = io::recognised(file);
        if (std::string reason = why_skipped(file, format); !reason.empty()) {
            skip(file, std::move(reason));
            return {};
        }
        CohortCase one;
        one.name = without_extension(relative, format);
        one.kind = format.volume != nullptr ? CaseKind::kMask : CaseKind::kTree;
        for (const fs::path& part : io::files_read_with(file)) {
            one.files.push_back({below(part), 0, 0, {}});
            part_of_others_.insert(part);
        }
        if (one.files.empty()) one.files.push_back({relative, 0, 0, {}}); // it vanished; reading it reports that
        one.folder = folder_word(one.name);
        const auto [known, is_new] = folders_.emplace(one.folder, relative);
        if (!is_new)
            return fail("two files are the same case, " + one.name + ": " + known->second + " and " + relative,
                        root_.string(), "rename one of them, or keep it elsewhere");
        if (is_dicom_format(format)) dicom_.emplace(file.parent_path(), one.name);
        found_.cases.push_back(std::move(one));
        return {};
    }

    // Several DICOM files in a folder are slices of a scan.
    void drop_series() {
        for (auto at = dicom_.begin(); at != dicom_.end();) {
            const auto end = dicom_.upper_bound(at->first);
            const auto count = static_cast<std::uint64_t>(std::distance(at, end));
            if (count > 1)
                skip(at->first, counted(count, "DICOM file", "DICOM files") +
                                    ": a series, which is no case; write its mask as one file");
            for (; at != end; ++at)
                if (count > 1)
                    std::erase_if(found_.cases, [&](const CohortCase& one) { return one.name == at->second; });
        }
    }

    const fs::path& root_;
    FoundCases found_;
    std::set<fs::path> part_of_others_;          // second tables of pairs, values of headers
    std::map<std::string, std::string> folders_; // of cases, and the file of each
    std::multimap<fs::path, std::string> dicom_; // folder, case
};

using KnownFiles = std::map<std::string, CaseFile>;

KnownFiles known_files(const nlohmann::ordered_json& earlier) {
    KnownFiles known;
    try {
        for (const auto& one : earlier.at("cases"))
            for (const auto& file : one.at("files")) {
                const CaseFile read{file.at("path"), file.at("bytes"), file.at("modified"), file.at("sha256")};
                known.emplace(read.path, read);
            }
    } catch (const nlohmann::json::exception&) { // of another version: all files are read
        known.clear();
    }
    return known;
}

// A file that cannot be read has no checksum; the step that reads it reports why.
void add_checksum(CaseFile& file, const fs::path& root, const KnownFiles& known) {
    std::error_code error;
    const fs::path path = root / file.path;
    file.bytes = fs::file_size(path, error);
    if (error) file.bytes = 0;
    file.modified = static_cast<std::int64_t>(fs::last_write_time(path, error).time_since_epoch().count());
    const auto same = known.find(file.path);
    if (same != known.end() && same->second.bytes == file.bytes && same->second.modified == file.modified) {
        file.sha256 = same->second.sha256;
        return;
    }
    file.sha256 = io::sha256_of(path).value_or("");
}

std::string joined_checksum(const std::vector<CaseFile>& files) {
    if (files.size() == 1) return files.front().sha256;
    std::string lines;
    for (const CaseFile& file : files) lines += file.sha256 + "  " + file.path + "\n";
    return io::sha256_base64(lines);
}

} // namespace

Result<FoundCases> find_cases(const fs::path& root, const nlohmann::ordered_json& earlier, Job& job) {
    RAMUS_TRY(found, Walk(root).run());
    const KnownFiles known = known_files(earlier);
    for (std::size_t n = 0; n < found.cases.size(); ++n) {
        if (job.cancelled()) return fail("cancelled");
        CohortCase& one = found.cases[n];
        for (CaseFile& file : one.files) add_checksum(file, root, known);
        one.sha256 = joined_checksum(one.files);
        job.report(static_cast<float>(n + 1) / static_cast<float>(found.cases.size()));
    }
    return std::move(found);
}

nlohmann::ordered_json case_json(const CohortCase& one, const fs::path& root) {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const CaseFile& file : one.files)
        files.push_back(
            {{"path", file.path}, {"bytes", file.bytes}, {"modified", file.modified}, {"sha256", file.sha256}});
    return {{"name", one.name},
            {"folder", one.folder},
            {"relative", one.files.front().path},
            {"file", (root / one.files.front().path).string()},
            {"kind", one.kind == CaseKind::kMask ? "mask" : "tree"},
            {"sha256", one.sha256},
            {"files", std::move(files)}};
}

} // namespace ramus::app
