#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace crossgrain::inline cli {

/// What a command line was refused for, in the words of this program, with the help that says what
/// would be right.
std::string explain(const CLI::ParseError& error, const CLI::App& app);

}  // namespace crossgrain::inline cli
