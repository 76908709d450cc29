#include "core/io/trees/xml_input.h"

#include "core/io/text_numbers.h"

namespace ramus::io {

Result<void> XmlInput::parse(std::string_view text, const std::string& name) {
    name_ = name;
    lines_ = LineIndex(text);
    if (auto few = check_xml(text, name); !few) return few;
    const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
    if (!result)
        return fail(std::string("this is not valid XML: ") + result.description(),
                    name + ":" + std::to_string(line_at(text, static_cast<std::size_t>(result.offset))),
                    "the file is incomplete or damaged; get it again");
    return {};
}

std::size_t XmlInput::line(const pugi::xml_node& node) const {
    const std::ptrdiff_t offset = node.offset_debug();
    return lines_.line(offset < 0 ? 0 : static_cast<std::size_t>(offset));
}

std::string XmlInput::place(const pugi::xml_node& node) const { return name_ + ":" + std::to_string(line(node)); }

bool begins_with_element(std::string_view head, std::string_view name) {
    for (std::size_t at = head.find('<'); at != std::string_view::npos; at = head.find('<', at)) {
        std::string_view end = ">";
        if (head.substr(at).starts_with("<!--"))
            end = "-->";
        else if (head.substr(at).starts_with("<?"))
            end = "?>";
        else if (!head.substr(at).starts_with("<!")) {
            const std::string_view tag = head.substr(at + 1);
            return tag.starts_with(name) && tag.size() > name.size() &&
                   std::string_view(" \t\r\n>/").find(tag[name.size()]) != std::string_view::npos;
        }
        const std::size_t behind = head.find(end, at);
        if (behind == std::string_view::npos) return false;
        at = behind;
    }
    return false;
}

} // namespace ramus::io
