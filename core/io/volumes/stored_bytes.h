// StoredBytes: a file whose parts are read in any order, on the disk or in memory. For formats whose headers point to
// other places of the file (DICOM, TIFF). ByteSource reads in order.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <string>

namespace ramus::io {

class ByteSource;

struct StoredBytes {
    std::filesystem::path path;               // empty: in memory
    std::shared_ptr<const std::string> bytes; // null: on the disk
    std::string name;                         // for errors

    // Registers a file on the disk as an input of this run (core/io/run_inputs.h).
    [[nodiscard]] Result<std::unique_ptr<std::istream>> open() const;
    [[nodiscard]] Result<std::uint64_t> size() const;
};

// The file of a source. A source that is no plain file (compressed, a pipe, memory) is read to its end into memory;
// fails if it takes more than `memory_bytes`.
[[nodiscard]] Result<StoredBytes> stored_bytes_of(ByteSource& source, double memory_bytes);

} // namespace ramus::io
