// What scripts/fuzz gives bytes to: every reader of a file, by the extension of its format, and the skeletonizer. A
// target takes any bytes. It throws where something is not as it must be; refusing the bytes with a whole Error is as
// it must be. The tests give every file of corpus/NAME to the target of that name.
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::fuzz {

struct Target {
    std::string name; // "swc"
    std::function<void(std::string_view bytes)> run;
};

[[nodiscard]] const std::vector<Target>& targets();

// Their parts, each in a file of its own.
[[nodiscard]] std::vector<Target> tree_targets();
[[nodiscard]] std::vector<Target> volume_targets();
[[nodiscard]] std::vector<Target> mesh_targets();
[[nodiscard]] std::vector<Target> session_targets();
[[nodiscard]] std::vector<Target> mask_targets();

inline void must(bool holds, const std::string& words) {
    if (!holds) throw std::logic_error(words);
}

// What people are told: what is wrong, and what to do. `file`: what its place must begin with.
inline void check_error(const Error& error, const std::string& file) {
    must(!error.what.empty(), "an error says nothing");
    must(error.where.starts_with(file), "an error is not of the file: " + error.message());
    must(!error.hint.empty(), "an error has no remedy: " + error.message());
}

// What VesselTree guarantees.
void check_tree(const tree::VesselTree& tree);

// The first of two files that stand one behind the other with a line of four equals signs between them, and the second.
[[nodiscard]] std::pair<std::string_view, std::string_view> two_files(std::string_view bytes);

// A file of that name in a folder of this process, in memory where TMPDIR is.
[[nodiscard]] std::string written_file(const std::string& name, std::string_view bytes);

} // namespace ramus::fuzz
