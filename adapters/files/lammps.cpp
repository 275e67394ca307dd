/// LAMMPS' and LIGGGHTS' dump custom and dump local.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <string>

#include "adapters/files/readers.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

using Meanings = std::vector<Meaning>;

/// Per-atom attributes of dump custom.
constexpr std::pair<std::string_view, Meaning> attributes[] = {
    {"id", Meaning::id},         {"type", Meaning::kind},
    {"x", Meaning::x},           {"y", Meaning::y},
    {"z", Meaning::z},           {"xs", Meaning::scaledX},
    {"ys", Meaning::scaledY},    {"zs", Meaning::scaledZ},
    {"radius", Meaning::radius}, {"diameter", Meaning::diameter},
    {"vx", Meaning::vx},         {"vy", Meaning::vy},
    {"vz", Meaning::vz},         {"omegax", Meaning::spinX},
    {"omegay", Meaning::spinY},  {"omegaz", Meaning::spinZ},
    {"mass", Meaning::mass},     {"xu", Meaning::x},
    {"yu", Meaning::y},          {"zu", Meaning::z},
    {"xsu", Meaning::scaledX},   {"ysu", Meaning::scaledY},
    {"zsu", Meaning::scaledZ}};

/// Header of a time: the lines before its rows.
struct Head {
  Part part;
  std::size_t rows = 0;
  std::vector<std::string> names;  ///< of columns
};

std::string_view afterItem(const TextFile& text) {
  constexpr std::string_view item = "ITEM: ";
  if (!text.line().starts_with(item)) text.fail("here should be ITEM: …, the head of a dump");
  return text.line().substr(item.size());
}

/// "xx yy zz" or "xy xz yz xx yy zz", then low and high [tilt] of each axis.
FileBox readBox(TextFile& text, std::string_view letters) {
  FileBox box;
  const auto periodic = words(letters);
  const bool triclinic = !periodic.empty() && periodic.front() == "xy";
  for (int k = 0; k < 3; ++k) {
    const auto bounds = words(text.need("the box"));
    if (bounds.size() != (triclinic ? 3u : 2u))
      text.fail("the box: should be low and high of an axis");
    box.low[k] = numberOf(text, bounds[0], "the box");
    box.high[k] = numberOf(text, bounds[1], "the box");
    if (triclinic && numberOf(text, bounds[2], "the tilt") != 0.0)
      text.fail("a tilted (triclinic) box is not read");
    const std::size_t axis = (triclinic ? 3u : 0u) + static_cast<std::size_t>(k);
    box.periodic[k] = axis < periodic.size() && periodic[axis].front() == 'p';
    box.saidFixed[k] = axis < periodic.size() && !box.periodic[k];
  }
  return box;
}

/// @param kind  "ATOMS" or "ENTRIES"
Head readHead(TextFile& text, std::string_view kind) {
  Head head;
  FileFrame& frame = head.part.frame;
  std::optional<std::int64_t> count;
  constexpr std::string_view number = "NUMBER OF ", bounds = "BOX BOUNDS";
  for (;;) {
    text.need("ITEM: …");
    const std::string item(afterItem(text));
    if (item.starts_with(kind)) {
      for (const std::string_view name : words(std::string_view(item).substr(kind.size())))
        head.names.emplace_back(name);
      break;
    }
    if (item.starts_with(bounds)) {
      frame.box = readBox(text, std::string_view(item).substr(bounds.size()));
    } else if (item.starts_with("TIMESTEP")) {
      frame.step = countOf(text, words(text.need("the step")).front(), "the step");
    } else if (item.starts_with("TIME")) {
      frame.time = numberOf(text, words(text.need("the time")).front(), "the time");
    } else if (item.starts_with(number)) {
      count = countOf(text, words(text.need("a number")).front(), item);
    } else if (item.starts_with("UNITS") || item.starts_with("LABEL")) {
      text.need("a word");
    } else {
      text.fail(fmt::format("here should be ITEM: {} … of the same dump, after its head", kind));
    }
  }
  if (!frame.step) text.fail("ITEM: TIMESTEP is missing before it");
  if (!count) text.fail(fmt::format("ITEM: NUMBER OF {} is missing before it", kind));
  if (head.names.empty()) text.fail("the names of its columns are missing");
  head.rows = text.rows(*count, head.names.size());
  frame.where = fmt::format("{}, step {}", text.path().string(), *frame.step);
  return head;
}

/// Columns name[1] … name[n] of one compute or fix, as they come.
std::size_t widthOf(const std::vector<std::string>& names, std::string_view array) {
  return static_cast<std::size_t>(std::ranges::count_if(
      names, [&](const std::string& name) { return splitIndex(name).first == array; }));
}

// ---- atoms ----

/// Eight columns per atom that `fix wall/gran … contacts` has: whether they touch, force by the
/// wall, where, radius of the atom.
struct WallColumns {
  std::string fix;
  std::size_t first = 0;  ///< of its extra meanings
};
constexpr std::size_t wallWidth = 8;

struct AtomColumns {
  Columns columns;
  std::vector<WallColumns> walls;
};

AtomColumns atomColumns(const TextFile& text, const std::vector<std::string>& names,
                        const ColumnOptions& options) {
  AtomColumns found;
  Meanings meanings;
  const auto isTaken = [&](Meaning meaning) {
    return std::ranges::find(meanings, meaning) != meanings.end();
  };
  std::size_t extra = 0;
  for (const std::string& name : names) {
    const auto [array, index] = splitIndex(name);
    const std::optional<Meaning> said = options.of(name);
    const bool isFix = index > 0 && array.starts_with("f_") && widthOf(names, array) == wallWidth;
    if (said == Meaning::wall || (!said && isFix) ||
        (said && isFix && options.of(array) == Meaning::wall)) {
      if (index == 1) {
        found.walls.push_back({std::string(array), extra});
        extra += wallWidth;
      }
      if (index == 0 || index > wallWidth || found.walls.empty() ||
          found.walls.back().fix != array || extra > extraMeanings)
        text.fail(fmt::format("{}: contacts with a wall are eight columns side by side, [1] to [8]",
                              array));
      meanings.push_back(extraMeaning(found.walls.back().first + index - 1));
      continue;
    }
    const auto* const known =
        std::ranges::find(attributes, lowered(name), [](const auto& one) { return one.first; });
    if (!said && known != std::end(attributes) &&
        std::ranges::count(names, lowered(name), lowered) > 1)
      text.fail(fmt::format("the column {} is there twice: only one of them can be read", name));
    const Meaning meaning = said                            ? *said
                            : known != std::end(attributes) ? known->second
                                                            : Meaning::none;
    // Of x and xu the first is taken.
    meanings.push_back(!said && meaning != Meaning::none && isTaken(meaning) ? Meaning::none
                                                                             : meaning);
  }
  found.columns = Columns(std::move(meanings));
  found.columns.checkDistinct(text);
  const bool scaled = found.columns.has(Meaning::scaledX) && found.columns.has(Meaning::scaledY);
  if (!scaled && !(found.columns.has(Meaning::x) && found.columns.has(Meaning::y)))
    text.fail("the columns x y z are missing: dump … custom … id type x y z radius …");
  // Rows come in any order, another one each time.
  if (!found.columns.has(Meaning::id))
    text.fail(
        "the column id is missing, by which a particle is known from one time to the next and in "
        "its contacts: dump … custom … id type x y z vx vy vz radius …");
  return found;
}

/// The row's contact with a wall, if they touch.
void addWall(ContactTable& table, const AtomColumns& atoms, std::size_t wall,
             const FileParticles& particles, const std::optional<FileBox>& box,
             const TextFile& text) {
  const auto value = [&](std::size_t k) {
    return atoms.columns[extraMeaning(atoms.walls[wall].first + k)];
  };
  if (value(0) == 0.0) return;
  const std::string& fix = atoms.walls[wall].fix;
  if (value(0) != 1.0)
    text.fail(
        fmt::format("{0}[1] is {1}, neither 0 nor 1: if {0} is no fix wall/gran … contacts, "
                    "say columns = {0}=-",
                    fix, value(0)));
  // Points are in the box, places may be of a path that is left whole.
  const Vec3 point(value(4), value(5), value(6));
  const Vec3 away = nearestImage(particles.position.back() - point, box);
  if (!(away.norm() > 0.0)) text.fail(fmt::format("{} touches the particle in its centre", fix));
  FileContacts& contacts = table.contacts;
  contacts.first.push_back(particles.id.back());
  contacts.second.push_back(-static_cast<std::int64_t>(wall) - 1);
  contacts.normal.push_back(away.normalized());
  contacts.force.emplace_back(value(1), value(2), value(3));
  contacts.point.push_back(point);
}

/// @param ofCase  its box
Part readAtoms(TextFile& text, const ColumnOptions& options, const std::optional<FileBox>& ofCase) {
  Head head = readHead(text, "ATOMS");
  FileFrame& frame = head.part.frame;
  if (frame.box && ofCase) takePeriods(*frame.box, *ofCase);
  AtomColumns atoms = atomColumns(text, head.names, options);
  Columns& columns = atoms.columns;
  const auto isScaled = [&](int axis) {
    return columns.has(following(Meaning::scaledX, axis)) &&
           !columns.has(following(Meaning::x, axis));
  };
  frame.particles.scaled = isScaled(0) || isScaled(1) || isScaled(2);
  if (frame.particles.scaled && !frame.box)
    text.fail("xs, ys, zs are parts of the box: ITEM: BOX BOUNDS is missing");
  if (!atoms.walls.empty()) {
    head.part.table.emplace();
    head.part.wallsAlone = true;
  }
  reserve(frame.particles, columns, head.rows);
  for (std::size_t k = 0; k < head.rows; ++k) {
    text.need("an atom");
    columns.read(text, ' ');
    for (int axis = 0; axis < 3; ++axis)
      if (isScaled(axis))
        columns[following(Meaning::x, axis)] =
            frame.box->low[axis] + columns[following(Meaning::scaledX, axis)] *
                                       (frame.box->high[axis] - frame.box->low[axis]);
    addParticle(frame.particles, columns, text);
    for (std::size_t wall = 0; wall < atoms.walls.size(); ++wall)
      addWall(*head.part.table, atoms, wall, frame.particles, frame.box, text);
  }
  return std::move(head.part);
}

// ---- contacts ----

/// One keyword of a compute, and the columns it makes.
struct Keyword {
  std::string_view name;
  Meanings columns;
};

/// compute pair/gran/local and wall/gran/local, in the order in which they come whatever the order
/// asked for (compute_pair_gran_local.cpp). History takes what is left.
const std::vector<Keyword>& granKeywords(bool ofWalls) {
  using enum Meaning;
  static const auto make = [](bool isWall) {
    const Meanings three{none, none, none}, six(6, none);
    return std::vector<Keyword>{
        {"pos", isWall ? Meanings{px, py, pz, x, y, z} : six},
        {"vel", six},
        {"id", isWall ? Meanings{second, none, first} : Meanings{first, second, none}},
        {"force", {fx, fy, fz}},
        {"force_normal", three},
        {"force_tangential", three},
        {"torque", isWall ? three : Meanings{torqueX, torqueY, torqueZ}},
        {"torque_normal", three},
        {"torque_tangential", three},
        {"history", {}},
        {"contactArea", {none}},
        {"delta", {overlap}},
        {"heatFlux", {none}},
        {"contactPoint", isWall ? three : Meanings{px, py, pz}},
        {"ms_id", {none, none}}};
  };
  static const std::vector<Keyword> pairs = make(false), walls = make(true);
  return ofWalls ? walls : pairs;
}

[[noreturn]] void unknownWord(std::string_view array, std::string_view style,
                              std::string_view word) {
  throw BadInput(fmt::format("columns: {}={},…: compute {} has no {} that is known here", array,
                             style, style, word));
}

Meanings granColumns(std::string_view array, const std::vector<std::string>& said,
                     std::size_t width) {
  const auto& keywords = granKeywords(said.front().starts_with("wall"));
  // Without keywords: all of old (its constructor).
  std::vector<std::string> asked(said.begin() + 1, said.end());
  if (asked.empty()) asked = {"pos", "vel", "id", "force", "torque", "history", "contactArea"};
  for (const std::string& word : asked)
    if (std::ranges::find(keywords, word, &Keyword::name) == keywords.end())
      unknownWord(array, said.front(), word);
  const auto isAsked = [&](std::string_view name) {
    return std::ranges::find(asked, name) != asked.end();
  };
  std::size_t known = 0;
  for (const Keyword& keyword : keywords)
    if (isAsked(keyword.name)) known += keyword.columns.size();
  if (known > width || (known < width && !isAsked("history")))
    throw BadInput(
        fmt::format("columns: {} has {} columns, its keywords would have {}", array, width, known));
  Meanings meanings;
  for (const Keyword& keyword : keywords) {
    if (!isAsked(keyword.name)) continue;
    meanings.insert(meanings.end(), keyword.columns.begin(), keyword.columns.end());
    if (keyword.name == "history") meanings.insert(meanings.end(), width - known, Meaning::none);
  }
  return meanings;
}

/// compute pair/local, property/local. p1–p3 are the tangential force on patom1, p5–p7 the rolling
/// pseudo-force and p10–p12 the branch of pair style granular alone, which is the one that has
/// twelve (single() of pair_gran_hooke_history.cpp and pair_granular.cpp).
Meanings localColumns(std::string_view array, const std::vector<std::string>& said) {
  using enum Meaning;
  constexpr std::pair<std::string_view, Meaning> keywords[] = {
      {"patom1", first},      {"patom2", second}, {"natom1", first}, {"natom2", second},
      {"force", normalForce}, {"p1", tx},         {"p2", ty},        {"p3", tz}};
  constexpr std::pair<std::string_view, Meaning> ofGranular[] = {
      {"p5", pseudoX},  {"p6", pseudoY},  {"p7", pseudoZ},
      {"p10", branchX}, {"p11", branchY}, {"p12", branchZ}};
  constexpr std::string_view leftOut[] = {"ptype1", "ptype2", "ntype1", "ntype2", "dist", "eng",
                                          "dx",     "dy",     "dz",     "fx",     "fy",   "fz"};
  const bool granular = std::ranges::find(said, "p12") != said.end();
  Meanings meanings;
  for (const std::string& word : said | std::views::drop(1)) {
    const auto isWord = [&](const auto& one) { return one.first == word; };
    const auto* const known = std::ranges::find_if(keywords, isWord);
    const auto* const rolling = std::ranges::find_if(ofGranular, isWord);
    const bool isNumbered = word.size() > 1 && word.front() == 'p' &&
                            word.find_first_not_of("0123456789", 1) == std::string::npos;
    if (known != std::end(keywords))
      meanings.push_back(known->second);
    else if (granular && rolling != std::end(ofGranular))
      meanings.push_back(rolling->second);
    else if (isNumbered || std::ranges::find(leftOut, word) != std::end(leftOut))
      meanings.push_back(none);
    else
      unknownWord(array, said.front(), word);
  }
  return meanings;
}

/// Default words for columns that the user does not describe: property/local patom1 patom2 and
/// pair/local force p1 p2 … of LAMMPS, pair/gran/local with pos id force, or without keywords, of
/// LIGGGHTS.
std::vector<std::string> usualWords(const TextFile& text, const std::vector<std::string>& names,
                                    std::string_view array) {
  std::vector<std::string> arrays;
  for (const std::string& name : names)
    if (const std::string one(splitIndex(name).first);
        one != "index" && std::ranges::find(arrays, one) == arrays.end())
      arrays.push_back(one);
  const std::size_t width = widthOf(names, array);
  if (arrays.size() == 2 && widthOf(names, arrays[0]) == 2) {
    if (array == arrays[0]) return {"property/local", "patom1", "patom2"};
    std::vector<std::string> said{"pair/local", "force"};
    for (std::size_t k = 1; k < width; ++k) said.push_back(fmt::format("p{}", k));
    return said;
  }
  if (arrays.size() == 1 && width == 12) return {"pair/gran/local", "pos", "id", "force"};
  if (arrays.size() == 1 && width >= 22) return {"pair/gran/local"};
  text.fail(
      fmt::format("what are its columns? say so by the computes' own keywords: columns = "
                  "{0}=property/local,patom1,patom2 c_…=pair/local,force,p1,p2,p3,p4 (LAMMPS) or "
                  "{0}=pair/gran/local,pos,id,force,… (LIGGGHTS)",
                  arrays.empty() ? "c_1" : arrays.front()));
}

struct EntryColumns {
  Columns columns;
  bool walls = false;    ///< of wall/gran/local
  bool guessed = false;  ///< the user does not describe them
};

EntryColumns entryColumns(const TextFile& text, const std::vector<std::string>& names,
                          const ColumnOptions& options) {
  EntryColumns found;
  const bool said = std::ranges::any_of(names, [&](const std::string& name) {
    return options.wordsOf(name) || options.wordsOf(splitIndex(name).first);
  });
  found.guessed = !said;
  Meanings meanings;
  for (const std::string& name : names) {
    const auto [array, index] = splitIndex(name);
    const std::vector<std::string>* own = options.wordsOf(array);
    std::vector<std::string> usual;
    if (!said && array != "index") {
      usual = usualWords(text, names, array);
      own = &usual;
    }
    if (!own || own->front().find('/') == std::string::npos) {
      meanings.push_back(said ? options.of(name).value_or(Meaning::none) : Meaning::none);
      continue;
    }
    const std::string& style = own->front();
    const bool gran = style == "pair/gran/local" || style == "wall/gran/local";
    if (!gran && style != "pair/local" && style != "property/local")
      unknownWord(array, style, "columns");
    found.walls = found.walls || style == "wall/gran/local";
    const Meanings all =
        gran ? granColumns(array, *own, widthOf(names, array)) : localColumns(array, *own);
    const std::size_t at = std::max<std::size_t>(index, 1) - 1;
    meanings.push_back(at < all.size() ? all[at] : Meaning::none);
  }
  found.columns = Columns(std::move(meanings));
  if (found.walls && !(found.columns.has(Meaning::x) && found.columns.has(Meaning::px)))
    text.fail("contacts with walls need their place: compute … wall/gran/local pos id force");
  checkContactColumns(found.columns, text);
  return found;
}

Part readEntries(TextFile& text, const ColumnOptions& options) {
  Head head = readHead(text, "ENTRIES");
  EntryColumns entries = entryColumns(text, head.names, options);
  Columns& columns = entries.columns;
  ContactTable& table = head.part.table.emplace();
  reserve(table, columns, head.rows);
  for (std::size_t k = 0; k < head.rows; ++k) {
    text.need("a contact");
    columns.read(text, ' ');
    const double one = columns[Meaning::first], other = columns[Meaning::second];
    if (entries.guessed &&
        (one != std::floor(one) || other != std::floor(other) || one < 0.0 || other < 0.0))
      text.fail(
          fmt::format("{} and {} should be the ids of two atoms; if the columns are others, say "
                      "which: columns = c_p=property/local,patom1,patom2 …",
                      one, other));
    if (entries.walls) {
      columns[Meaning::second] = -columns[Meaning::second] - 1.0;  // meshes count from 0
      table.branch.push_back(columns.vector(Meaning::x) - columns.vector(Meaning::px));
    }
    addContact(table, columns, text);
  }
  return std::move(head.part);
}

}  // namespace

Content contentOfLammps(const fs::path& file) {
  TextFile text(file);
  for (int line = 0; line < 1000 && text.next(); ++line) {
    if (text.line().starts_with("ITEM: ATOMS") || text.line().starts_with("ITEM: NUMBER OF ATOMS"))
      return Content::particles;
    if (text.line().starts_with("ITEM: ENTRIES") ||
        text.line().starts_with("ITEM: NUMBER OF ENTRIES"))
      return Content::contacts;
  }
  text.fail("this is neither dump custom (ITEM: ATOMS) nor dump local (ITEM: ENTRIES)");
}

double firstTimeOfLammps(const fs::path& file) {
  TextFile text(file);
  while (text.next())
    if (text.line().starts_with("ITEM: TIMESTEP"))
      return numberOf(text, words(text.need("the step")).front(), "the step");
  text.fail("ITEM: TIMESTEP is missing");
}

std::unique_ptr<FrameReader> openLammps(const Files& files, const FileOptions& options) {
  const auto columns = std::make_shared<const ColumnOptions>(options.columns);
  std::vector<std::unique_ptr<PartReader>> contacts;
  for (Files& dump : bySeries(filesOf(files, Content::contacts, contentOfLammps)))
    contacts.push_back(std::make_unique<TextParts>(
        std::move(dump), [columns](TextFile& text) { return readEntries(text, *columns); }));
  // Words for columns of contacts are no mistake where there are only atoms.
  const auto checked = contacts.empty() ? nullptr : columns;
  auto atoms = std::make_unique<TextParts>(
      filesOf(files, Content::particles, contentOfLammps),
      [columns, box = options.box](TextFile& text) { return readAtoms(text, *columns, box); });
  return joinParts(std::move(atoms), std::move(contacts), checked);
}

}  // namespace crossgrain::files
