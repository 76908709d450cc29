// Parses XML files with pugixml and finds the lines of elements for messages. Entities that a file declares are not
// expanded, so they cannot grow. Callers must traverse the elements without recursion.
#pragma once

#include "core/base/error.h"
#include "core/io/xml_text.h"

#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace ramus::io {

class XmlInput {
public:
    // Fails on invalid XML, with its line, and like check_xml() (xml_text.h). `text` and `name` must outlive this.
    [[nodiscard]] Result<void> parse(std::string_view text, const std::string& name);

    [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
    [[nodiscard]] std::size_t line(const pugi::xml_node& node) const;
    [[nodiscard]] std::string place(const pugi::xml_node& node) const;

private:
    std::string name_;
    pugi::xml_document document_;
    LineIndex lines_;
};

// Whether the first element of the file is called `name`. Ignores text before it.
[[nodiscard]] bool begins_with_element(std::string_view head, std::string_view name);

} // namespace ramus::io
