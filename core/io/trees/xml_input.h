// Files of XML, parsed by pugixml, with the lines where their elements stand. Entities that a file declares itself are
// not replaced, so that none can grow; whoever goes through the elements does it without recursion.
#pragma once

#include "core/base/error.h"
#include "core/io/xml_text.h"

#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace ramus::io {

class XmlInput {
public:
    // Fails with the line of what is not XML, and where check_xml() does. `text` and `name` must outlive this.
    [[nodiscard]] Result<void> parse(std::string_view text, const std::string& name);

    [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
    [[nodiscard]] std::size_t line(const pugi::xml_node& node) const;
    [[nodiscard]] std::string place(const pugi::xml_node& node) const;

private:
    std::string name_;
    pugi::xml_document document_;
    LineIndex lines_;
};

// Whether the first element of the file is called so; what stands before it is of no account.
[[nodiscard]] bool begins_with_element(std::string_view head, std::string_view name);

} // namespace ramus::io
