#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

/// Text for a terminal: its width, and lines that fit.
namespace crossgrain::inline support {

/// Columns of the terminal: COLUMNS of the environment, else those of the descriptor's terminal,
/// else 80.
std::size_t terminalWidth(int descriptor);

/// Characters, not bytes: all that the program prints are one place wide.
std::size_t displayWidth(std::string_view text);

/// With blanks up to the width.
std::string padded(std::string text, std::size_t width);

/// The beginning of a line that does not fit, with "…" at its end.
std::string cut(const std::string& line, std::size_t width);

/// One line as several of at most that width, broken at blanks; a longer word stays whole.
/// @param hang  blanks before each line but the first
/// @param end   of each line but the last: " \\" where a shell is to read them as one
std::string wrapped(const std::string& line, std::size_t width, std::size_t hang,
                    std::string_view end = "");

/// Each line of a text so, further lines two blanks further in than the first; of a comment, which
/// begins with "# ", all do.
std::string wrappedLines(const std::string& text, std::size_t width);

/// Prints lines, on a terminal wrapped at its width; elsewhere a line stays one.
void printLines(std::FILE* to, const std::string& text);

}  // namespace crossgrain::inline support
