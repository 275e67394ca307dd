#include "reports/common/headings.hpp"

#include <fmt/format.h>

#include <cctype>
#include <set>
#include <string_view>

namespace crossgrain::reports {

namespace {

/// "All pairs" → "all-pairs": ASCII letters and digits of what is between tags.
std::string slugOf(std::string_view html) {
  std::string slug;
  bool inTag = false;
  for (const char c : html) {
    inTag = c == '<' || (inTag && c != '>');
    const auto byte = static_cast<unsigned char>(c);
    if (!inTag && std::isalnum(byte))
      slug += static_cast<char>(std::tolower(byte));
    else if (!slug.empty() && slug.back() != '-')
      slug += '-';
  }
  while (slug.ends_with('-')) slug.pop_back();
  return slug.empty() ? "part" : slug;
}

std::string unique(const std::string& slug, std::set<std::string>& taken) {
  std::string id = slug;
  for (int k = 2; !taken.insert(id).second; ++k) id = fmt::format("{}-{}", slug, k);
  return id;
}

/// All ids there are: a made one must be none of them.
std::set<std::string> idsIn(const std::string& html) {
  constexpr std::string_view attribute = " id=\"";
  std::set<std::string> ids;
  for (std::size_t at = html.find(attribute); at != std::string::npos;
       at = html.find(attribute, at)) {
    at += attribute.size();
    ids.insert(html.substr(at, html.find('"', at) - at));
  }
  return ids;
}

}  // namespace

std::string withAnchors(const std::string& html) {
  std::set<std::string> taken = idsIn(html);
  std::string result;
  std::size_t from = 0;
  for (std::size_t at = html.find("<h"); at != std::string::npos; at = html.find("<h", from)) {
    const char level = at + 2 < html.size() ? html[at + 2] : ' ';
    const std::size_t open = html.find('>', at);
    const std::size_t close = html.find(fmt::format("</h{}>", level), at);
    if ((level != '2' && level != '3') || open == std::string::npos || close == std::string::npos) {
      result.append(html, from, at + 2 - from);
      from = at + 2;
      continue;
    }
    const std::string tag = html.substr(at, open - at),
                      words = html.substr(open + 1, close - open - 1);
    const std::size_t has = tag.find(" id=\"");
    const std::string id = has == std::string::npos
                               ? unique(slugOf(words), taken)
                               : tag.substr(has + 5, tag.find('"', has + 5) - has - 5);
    result.append(html, from, at - from);
    result += tag;
    if (has == std::string::npos) result += fmt::format(" id=\"{}\"", id);
    result += fmt::format(
        ">{}<a class=\"anchor\" href=\"#{}\" aria-label=\"Link to this part\">#</a>", words, id);
    from = close;
  }
  return result.append(html, from);
}

}  // namespace crossgrain::reports
