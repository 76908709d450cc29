#include "core/io/volumes/stored_bytes.h"

#include "core/io/run_inputs.h"
#include "core/io/volumes/byte_source.h"

#include <fstream>
#include <sstream>
#include <system_error>

namespace ramus::io {

Result<std::unique_ptr<std::istream>> StoredBytes::open() const {
    if (bytes != nullptr) return std::make_unique<std::istringstream>(*bytes);
    auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
    if (!*file) return fail("cannot be opened", name, "check its permissions");
    note_input(path);
    return file;
}

Result<std::uint64_t> StoredBytes::size() const {
    if (bytes != nullptr) return bytes->size();
    std::error_code error;
    const auto found = std::filesystem::file_size(path, error);
    if (error) return fail("cannot be read: " + error.message(), name, "name a file");
    return found;
}

Result<StoredBytes> stored_bytes_of(ByteSource& source, double memory_bytes) {
    std::error_code error;
    if (!source.path().empty() && !source.is_gzip() && std::filesystem::is_regular_file(source.path(), error))
        return StoredBytes{source.path(), nullptr, source.name()};
    auto bytes = std::make_shared<std::string>();
    constexpr std::size_t kAtOnce = std::size_t{1} << 20;
    for (std::size_t got = kAtOnce; got == kAtOnce;) {
        const std::size_t before = bytes->size();
        if (static_cast<double>(before) > memory_bytes)
            return fail("the file takes more memory than is left to it", source.name(), "allow more with --memory");
        bytes->resize(before + kAtOnce);
        RAMUS_TRY(some, source.read_some(bytes->data() + before, kAtOnce));
        got = some;
        bytes->resize(before + got);
    }
    return StoredBytes{{}, bytes, source.name()};
}

} // namespace ramus::io
