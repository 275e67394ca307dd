#pragma once

#include <string>

namespace crossgrain::reports {

/// A page whose headings (h2, h3) can each be linked to: one without an id gets one made of its
/// words, and each ends with a link to itself.
std::string withAnchors(const std::string& html);

}  // namespace crossgrain::reports
