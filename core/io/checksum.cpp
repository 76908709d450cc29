#include "core/io/checksum.h"

#include "core/io/binary_numbers.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/csv_pair.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <openssl/evp.h>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;

class Sha256 {
public:
    Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
        good_ = context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1;
    }
    void add(std::string_view bytes) {
        good_ = good_ && EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1;
    }
    // The 32 bytes. Empty: libcrypto failed.
    [[nodiscard]] std::string bytes() {
        std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
        unsigned size = 0;
        if (!good_ || EVP_DigestFinal_ex(context_.get(), sum.data(), &size) != 1) return {};
        return {sum.begin(), sum.begin() + size};
    }
    [[nodiscard]] std::string digits() { // hexadecimal
        constexpr const char* kDigits = "0123456789abcdef";
        std::string text;
        for (const char byte : bytes()) {
            text += kDigits[static_cast<unsigned char>(byte) >> 4U];
            text += kDigits[static_cast<unsigned char>(byte) & 15U];
        }
        return text;
    }

private:
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
    bool good_ = false;
};

Result<std::string> sum_of(std::istream& stream, const fs::path& path) {
    Sha256 sum;
    std::vector<char> block(1 << 16);
    while (stream) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        sum.add({block.data(), static_cast<std::size_t>(stream.gcount())});
    }
    std::string digits = sum.digits();
    if (!stream.eof() || digits.empty())
        return fail("the file cannot be read", path.string(), "check the name and its permissions");
    return digits;
}

std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        if (at->is_regular_file(ignored)) files.push_back(at->path());
    }
    std::ranges::sort(files);
    return files;
}

std::string without_blanks(std::string_view text) {
    std::string rest;
    for (const char c : text)
        if (c != ' ' && c != '\t' && c != '\r') rest += c;
    return rest;
}

// The file of values that a header of NRRD or MetaImage names. Empty: it names none.
std::string values_of(const fs::path& header) {
    constexpr int kMostLines = 200; // searched, so that a file without a header is not read as a whole
    std::ifstream stream(header, std::ios::binary);
    std::string line;
    std::array<char, 4096> text{};
    for (int n = 0; n < kMostLines && stream.getline(text.data(), text.size()); ++n) {
        line = text.data();
        const std::size_t parted = line.find_first_of(":=");
        if (parted == std::string::npos) continue;
        const std::string name = lower_case(without_blanks(line.substr(0, parted)));
        if (name != "datafile" && name != "elementdatafile") continue;
        const std::size_t from = line.find_first_not_of(" \t", parted + 1);
        const std::size_t to = line.find_last_not_of(" \t\r");
        return from == std::string::npos || to < from ? std::string() : line.substr(from, to + 1 - from);
    }
    return {};
}

} // namespace

Result<std::string> sha256_of(const fs::path& path) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
        std::ifstream stream(path, std::ios::binary);
        return sum_of(stream, path);
    }
    std::string lines;
    for (const fs::path& file : files_below(path)) {
        RAMUS_TRY(sum, sha256_of(file));
        lines += sum + "  " + file.lexically_relative(path).string() + "\n";
    }
    std::istringstream stream(lines);
    return sum_of(stream, path);
}

std::string sha256_base64(std::string_view bytes) {
    Sha256 sum;
    sum.add(bytes);
    return base64_encoded(sum.bytes());
}

std::vector<fs::path> files_read_with(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return files_below(path);
    std::vector<fs::path> files;
    const auto add = [&](const fs::path& file) {
        std::error_code ignored;
        const bool is = fs::is_regular_file(file, ignored);
        if (is && std::ranges::find(files, file) == files.end()) files.push_back(file);
        return is;
    };
    add(path);
    const std::string extension = lower_case(path.extension().string());
    if (extension == ".csv") {
        for (const bool nodes : {true, false})
            for (const fs::path& partner : partner_names(path, nodes))
                if (add(partner)) break;
    } else if (extension == ".nhdr" || extension == ".nrrd" || extension == ".mhd" || extension == ".mha") {
        if (const std::string values = values_of(path); !values.empty()) add(path.parent_path() / values);
    }
    return files;
}

} // namespace ramus::io
