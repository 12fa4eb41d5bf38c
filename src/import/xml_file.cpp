#include "import/xml_file.h"

#include "import/xml_encoding.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace sundog
{

namespace
{

// pugixml's sentences, with what most often lies behind them.
std::string explain(const pugi::xml_parse_result& result, bool at_end)
{
    switch (result.status) {
    case pugi::status_no_document_element:
        return "no XML element in the file; a scene starts with <scene version=\"3.0.0\">";
    case pugi::status_end_element_mismatch:
        return at_end ? "the file ends before all elements are closed: is it truncated?" : "an end tag does not match its start tag";
    case pugi::status_bad_attribute:
        return at_end ? "an element ends early: is the file truncated?" : "malformed attribute: write name=\"value\"";
    case pugi::status_bad_comment:
        return "a comment is not closed with -->";
    default:
        break;
    }
    std::string text = result.description();
    std::transform(text.begin(), text.begin() + 1, text.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
    return at_end ? text + ": is the file truncated?" : text;
}

} // namespace

XmlFile::XmlFile(const std::filesystem::path& file, const SourceLocation& wanted_at, FileKind kind) : name_(file.string())
{
    const std::string text = utf8_of_xml(read_text_file(file, wanted_at, kind), {name_, 1});
    size_ = text.size();
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); i++)
        if (text[i] == '\n') line_starts_.push_back(static_cast<std::ptrdiff_t>(i + 1));

    const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
        const bool at_end = text.find('>', static_cast<std::size_t>(result.offset)) == std::string::npos;
        const int line = result.status == pugi::status_no_document_element ? 0 : line_of(result.offset);
        throw SceneError({name_, line}, explain(result, at_end));
    }
    for (auto node = root().next_sibling(); node; node = node.next_sibling())
        if (node.type() == pugi::node_element) throw SceneError(where(node), "a second root element <" + std::string(node.name()) + ">");
}

SourceLocation XmlFile::where(pugi::xml_node node) const
{
    // Text starts where its blanks end.
    const std::string_view value = node.type() == pugi::node_element ? "" : node.value();
    const std::size_t blanks = std::min(value.find_first_not_of(" \t\r\n"), value.size());
    return {name_, line_of(node.offset_debug() + static_cast<std::ptrdiff_t>(blanks))};
}

int XmlFile::line_of(std::ptrdiff_t offset) const
{
    const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), std::max<std::ptrdiff_t>(offset, 0));
    return static_cast<int>(after - line_starts_.begin());
}

} // namespace sundog
