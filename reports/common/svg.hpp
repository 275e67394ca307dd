#pragma once

#include <string>

namespace crossgrain::reports {

/// A drawing of gnuplot's in about half the bytes, looking the same: numbers to a tenth of a pixel,
/// short colours, no empty groups, no blanks between elements.
std::string compactSvg(const std::string& svg);

/// A drawing as the address of an image, "data:image/svg+xml,…", for an attribute in double quotes:
/// a fifth less than in base64. It has neither tags nor colons of other addresses.
std::string svgAddress(const std::string& svg);

/// What gnuplot made without its upper part. @param top  [px] that is left out
std::string withoutTop(const std::string& svg, int top);

}  // namespace crossgrain::reports
