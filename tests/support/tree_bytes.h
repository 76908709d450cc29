// Bytes of files that readers of trees are given, and what they say about bad ones.
#pragma once

#include "core/io/trees/tree_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <doctest/doctest.h>
#include <string>
#include <vector>

namespace ramus::test {

// Numbers as they lie in binary files.
template <class T, class From> std::string packed(const std::vector<From>& values, std::endian order) {
    std::string bytes;
    for (const From& value : values) {
        const T number = static_cast<T>(value);
        char raw[sizeof(T)];
        std::memcpy(raw, &number, sizeof(T));
        if (order != std::endian::native) std::reverse(raw, raw + sizeof(T));
        bytes.append(raw, sizeof(T));
    }
    return bytes;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

// The message about a file that must be refused, with its name and what to do.
inline std::string refusal(const std::string& bytes, const std::string& name) {
    const auto tree = io::parse_tree(bytes, name);
    REQUIRE_FALSE(tree.has_value());
    CHECK(tree.error().where.starts_with(name));
    CHECK_FALSE(tree.error().hint.empty());
    return tree.error().message();
}

} // namespace ramus::test
