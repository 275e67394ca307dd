#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include "adapters/registry.hpp"
#include "cases/case_files.hpp"
#include "cli/help.hpp"
#include "support/data_folder.hpp"

namespace crossgrain::inline cli {
namespace {

namespace fs = std::filesystem;
using Candidates = std::vector<std::string>;

/// Values that a help text lists: "allow|cut".
Candidates valuesIn(const std::string& list) {
  Candidates values;
  std::istringstream text(list);
  for (std::string value; std::getline(text, value, '|');) values.push_back(value);
  return values;
}

Candidates engines() {
  Candidates names = {"all"};
  for (const EngineEntry& entry : engineRegistry()) names.push_back(entry.name);
  return names;
}

/// The part of a path up to the folder that follows what is typed: case files are many.
std::string nextStep(const std::string& path, const std::string& typed) {
  const auto slash = path.find('/', typed.size());
  return slash == path.npos ? path : path.substr(0, slash + 1);
}

/// Files and folders here, and case files as installed where the path leads to none here.
Candidates paths(const std::string& typed, bool cases) {
  Candidates found;
  const auto slash = typed.rfind('/');
  const std::string folder = slash == typed.npos ? "" : typed.substr(0, slash + 1);
  std::error_code unreadable;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, unreadable), end;
       !unreadable && at != end; at.increment(unreadable))
    if (const std::string name = at->path().filename(); typed != folder || name[0] != '.')
      found.push_back(folder + name + (at->is_directory(unreadable) ? "/" : ""));
  if (const fs::path shipped = hereOrInstalled("cases"); cases && fs::is_directory(shipped))
    for (const CaseSummary& each : casesBelow(shipped))
      found.push_back(nextStep(("cases" / each.file.lexically_relative(shipped)).string(), typed));
  return found;
}

/// Values that an option or argument can have. @param typed  its beginning
Candidates valuesOf(const CLI::Option& option, const std::string& typed) {
  const std::string type = option.get_type_name();
  const auto is = [&](const char* part) { return type.find(part) != type.npos; };
  if (type == "NAMES" || is("|NAME")) {
    // Behind the last comma; what stands before it stays.
    const auto comma = typed.rfind(',');
    const std::string before = comma == typed.npos ? "" : typed.substr(0, comma + 1);
    Candidates names = engines();
    std::ranges::move(paths(typed.substr(before.size()), false), std::back_inserter(names));
    for (std::string& name : names) name.insert(0, before);
    return names;
  }
  if (type == "COMMAND") return publicCommands();
  if (is("|")) return valuesIn(type);
  if (is("FILE") || is("FOLDER") || is("RUN.h5") || is("SITE"))
    return paths(typed, option.get_name() == "case" || is("CASE"));
  return {};
}

/// The option that waits for the word behind it; null: none does.
const CLI::Option* optionAt(const CLI::App& app, const std::string& word) {
  if (word.empty() || word[0] != '-') return nullptr;
  const CLI::Option* option = app.get_option_no_throw(word);
  return option && option->get_expected_max() > 0 ? option : nullptr;
}

/// The argument that a word without an option is.
const CLI::Option* argumentAt(const CLI::App& app, std::size_t place) {
  const auto all = app.get_options([](const CLI::Option* each) { return each->get_positional(); });
  for (const CLI::Option* argument : all) {
    const auto most = static_cast<std::size_t>(argument->get_expected_max());
    if (place < most) return argument;
    place -= most;
  }
  return nullptr;
}

const CLI::App* commandOf(const CLI::App& program, const std::string& name) {
  const auto found =
      program.get_subcommands([&](const CLI::App* each) { return each->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

Candidates optionsOf(const CLI::App& app) {
  Candidates names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

}  // namespace

Candidates completionsOf(const CLI::App& program, const Candidates& words) {
  Candidates given;
  bool equals = false;  // was a word of its own
  for (const std::string& word : words) {
    if (!given.empty() && (equals || (word == "=" && given.back().starts_with("--"))))
      given.back() += word;
    else
      given.push_back(word);
    equals = word == "=" && !equals;
  }
  const std::string last = given.empty() ? "" : given.back();
  if (!given.empty()) given.pop_back();

  std::string typed = last;
  Candidates all;
  if (given.empty()) {
    all = typed.starts_with("-") ? optionsOf(program) : publicCommands();
  } else if (const CLI::App* app = commandOf(program, given.front())) {
    const CLI::Option* value = nullptr;
    std::size_t arguments = 0;
    for (std::size_t k = 1; k < given.size(); ++k) {
      const bool isValue = value != nullptr;
      value = isValue ? nullptr : optionAt(*app, given[k]);
      arguments += !isValue && !given[k].starts_with("-");
    }
    if (const auto at = last.find('='); !value && last.starts_with("--") && at != last.npos) {
      value = optionAt(*app, last.substr(0, at));
      typed = last.substr(at + 1);
    } else if (!value && !last.starts_with("-")) {
      value = argumentAt(*app, arguments);
    }
    if (value)
      all = valuesOf(*value, typed);
    else if (typed == last)
      all = optionsOf(*app);
  }
  // A word that holds its option, too, is replaced as a whole.
  const bool whole = !words.empty() && words.back() == last;
  const std::string before = whole ? last.substr(0, last.size() - typed.size()) : "";
  std::set<std::string> fitting;
  for (const std::string& word : all)
    if (word.starts_with(typed)) fitting.insert(before + word);
  return {fitting.begin(), fitting.end()};
}

}  // namespace crossgrain::inline cli
