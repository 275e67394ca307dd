#include "reports/render/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>

#include "reports/common/engines.hpp"
#include "support/files.hpp"

namespace crossgrain::reports {

namespace {

/// One of its figures or pictures; empty where it was not drawn.
std::string htmlDrawing(const Report& report, const std::string& name,
                        const DrawnFigures& drawings) {
  const auto svg = readFile(drawings.folder / (name + ".svg"));
  if (!svg) return {};
  std::string title, caption, width;
  bool wide = false, onPaper = true;
  if (const auto figure = std::ranges::find(report.figures, name, &Figure::name);
      figure != report.figures.end()) {
    title = figure->title;
    caption = figure->caption;
    if (std::ranges::any_of(figure->panels, keyIsTooLong)) caption += " Colours: the legend above.";
    // As wide as its letters need to stay readable, and no wider than they look well.
    constexpr double smallest = 12.0, readableOnes = 11.0;  // letters of gnuplot.cpp [px]
    constexpr double column = 640.0;                        // of a figure beside another [px]
    const double own = widthOf(*figure);
    width = fmt::format(" style=\"min-width:{:.0f}px;max-width:{:.0f}px\"",
                        std::ceil(own * readableOnes / smallest), 1.35 * own);
    wide = own > column;
  } else if (const auto picture = std::ranges::find(report.pictures, name, &Picture::name);
             picture != report.pictures.end()) {
    title = picture->title;
    caption = picture->engine + ". " + picture->scale;
    onPaper = picture->shows == Picture::Shows::forces || picture->shows == Picture::Shows::worst;
  }
  const std::string file = fmt::format("plots/{}.svg", escaped(name));
  return fmt::format(
      "<figure{}>\n<div class=\"plot\"><img{} alt=\"{}\" {}{}></div>\n<figcaption>{} <span "
      "class=\"file\">{}{}</span></figcaption>\n</figure>\n",
      wide ? " class=\"wide\"" : "", onPaper ? " class=\"onpaper\"" : "", escaped(title),
      drawings.ofSite ? fmt::format("loading=\"lazy\" src=\"{}\"", file)
                      : fmt::format("src=\"data:image/svg+xml;base64,{}\"", base64(*svg)),
      width, mathHtml(caption), file, drawings.ofSite ? "" : ", .pdf");
}

/// "All pairs" → "all-pairs".
std::string slugOf(const std::string& words) {
  std::string slug;
  for (const char c : words)
    if (const auto byte = static_cast<unsigned char>(c); std::isalnum(byte))
      slug += static_cast<char>(std::tolower(byte));
    else if (!slug.empty() && slug.back() != '-')
      slug += '-';
  while (slug.ends_with('-')) slug.pop_back();
  return slug.empty() ? "part" : slug;
}

std::string swatch(const LineStyle& style) {
  return fmt::format(R"(<span class="swatch{}" style="border-color:{}"></span>)",
                     style.dashed ? " dashed" : "", style.colour);
}

/// An engine's name with its colour before it, where the report has that engine.
class EngineNames {
 public:
  explicit EngineNames(const std::vector<EngineRow>& engines)
      : engines_(engines), styles_(engineStyles(engines)) {}

  std::string operator()(const std::string& name) const {
    const auto engine = std::ranges::find(engines_, name, &EngineRow::name);
    if (engine == engines_.end()) return mathHtml(name);
    return swatch(styles_[static_cast<std::size_t>(engine - engines_.begin())]) + mathHtml(name);
  }

 private:
  const std::vector<EngineRow>& engines_;
  std::vector<LineStyle> styles_;
};

std::string linked(const std::string& address, const std::string& content) {
  if (address.empty()) return content;
  return fmt::format(R"(<a href="{}">{}</a>)", escaped(address), content);
}

// --- bars on an axis of margins

constexpr double barWidth = 180.0, barHeight = 18.0;  // [px]

/// Place on an axis that ends at ±reach, from the left [px].
double onAxis(double margins, double reach) {
  return 0.5 * barWidth * (1.0 + std::clamp(margins / reach, -1.0, 1.0) * 0.92);
}

/// Band, zero and interval; what lies beyond the axis is an arrow at its end.
std::string htmlBar(const MarginBar& bar, double reach, std::string_view verdict) {
  const auto x = [&](double margins) { return onAxis(margins, reach); };
  constexpr double middle = 0.5 * barHeight;
  std::string text = fmt::format(
      "<svg class=\"bar {0}\" viewBox=\"0 0 {1} {2}\" width=\"{1}\" height=\"{2}\" role=\"img\" "
      "aria-label=\"{3}\">"
      "<title>{3}</title><rect class=\"band\" x=\"{4:.1f}\" width=\"{5:.1f}\" height=\"{2}\"/>"
      "<path class=\"zero\" d=\"M{6:.1f} 0v{2}\"/>",
      verdict, barWidth, barHeight, escaped(bar.title), x(-1.0), x(1.0) - x(-1.0), x(0.0));
  const double low = bar.low.value_or(bar.middle), high = bar.high.value_or(bar.middle);
  text +=
      fmt::format("<path class=\"interval\" d=\"M{:.1f} {}H{:.1f}\"/>", x(low), middle, x(high));
  for (const double sign : {-1.0, 1.0})
    if (sign * (sign > 0.0 ? high : low) > reach)
      text += fmt::format("<path d=\"M{:.1f} {}l{} -5v10z\"/>", x(sign * reach) + sign * 3.0,
                          middle, -sign * 8.0);
  if (std::abs(bar.middle) <= reach)
    text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{}\" r=\"4\"/>", x(bar.middle), middle);
  return text + "</svg>";
}

/// The axis' numbers above them.
std::string htmlAxis(const std::string& name, double reach) {
  std::string text = mathHtml(name) +
                     fmt::format(
                         "<svg class=\"bar\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
                         "aria-hidden=\"true\">",
                         barWidth, barHeight);
  const int step = reach > 4.0 ? 2 : 1;
  for (int at = -step * static_cast<int>(reach / step); at <= reach; at += step)
    text += fmt::format("<text x=\"{:.1f}\" y=\"13\">{}{}</text>", onAxis(at, reach),
                        at < 0 ? "−" : "", std::abs(at));
  return text + "</svg>";
}

// --- the matrix

std::string meaningOf(const Overview& overview, const VerdictLook& look) {
  const auto own = std::ranges::find(overview.states, look.verdict, &VerdictWords::verdict);
  return own == overview.states.end() ? std::string(look.words) : own->words;
}

/// The part of this page that it leads to.
std::string addressOf(const std::string& anchor) {
  return anchor.empty() ? anchor : "#" + anchor;
}

std::string matrixCell(const Overview& overview, const OverviewCell& cell,
                       const std::string& question) {
  const VerdictLook& look = lookOf(cell.verdict);
  const std::string meaning = meaningOf(overview, look);
  const std::string content =
      fmt::format(R"(<b><span class="mark" role="img" aria-label="{}">{}</span> {}</b>{})",
                  escaped(meaning), look.mark, mathHtml(cell.shown),
                  cell.words.empty() ? "" : "<small>" + mathHtml(cell.words) + "</small>");
  return fmt::format(R"(<td class="cell {}" data-asks="{}" title="{}">{}</td>)", look.cssClass,
                     escaped(question),
                     escaped(cell.words.empty() ? meaning : meaning + ": " + cell.words),
                     linked(addressOf(cell.anchor), content));
}

/// Legend of the marks that occur.
std::string marksOf(const Overview& overview, bool wrapped) {
  std::set<std::optional<Verdict>> seen;
  for (const OverviewRow& row : overview.rows)
    for (const OverviewCell& cell : row.cells) seen.insert(cell.verdict);
  if (wrapped) seen.erase(Verdict::notApplicable);  // such cells are not there
  std::string marks = "<p class=\"small marks\">";
  for (const VerdictLook& look : verdictLooks)
    if (seen.contains(look.verdict))
      marks += fmt::format(R"(<span><b class="mark {}">{}</b> {}</span> )", look.cssClass,
                           look.mark, mathHtml(meaningOf(overview, look)));
  return marks + "Every cell links to its evidence.</p>\n";
}

/// How many lines a row's small words take on a page of 1280 px, about.
std::size_t linesOf(const OverviewRow& row) {
  constexpr std::size_t letters = 150;  // of a line of small words over all cells
  const std::size_t each = letters / std::max<std::size_t>(row.cells.size(), 1);
  std::size_t lines = 0;
  for (const OverviewCell& cell : row.cells)
    lines = std::max(lines, (cell.words.size() + each - 1) / each);
  return lines;
}

/// The most lines of small words that rows may have for the matrix to end within 800 px.
std::size_t mostLines(const std::vector<OverviewRow>& rows) {
  constexpr std::size_t room = 648;            // below the heads [px]
  constexpr std::size_t mark = 26, line = 16;  // of a row [px]
  for (std::size_t most = 4; most > 1; --most) {
    std::size_t height = 0;
    for (const OverviewRow& row : rows) height += mark + line * std::min(most, linesOf(row));
    if (height <= room) return most;
  }
  return 1;
}

/// Rows of a list too long for a small screen that wait there until they are asked for: all but the
/// gravest.
std::set<const OverviewRow*> laterRows(const Overview& overview) {
  constexpr std::size_t mostAnswers = 8;
  std::vector<const OverviewRow*> rows;
  for (const OverviewRow& row : overview.rows) rows.push_back(&row);
  const std::size_t answers = overview.columns.size();
  if (rows.size() * answers <= mostAnswers) return {};
  std::ranges::stable_sort(rows, std::greater(),
                           [](const OverviewRow* row) { return mostSevere(*row); });
  const std::size_t inSight = std::max<std::size_t>(mostAnswers / answers, 1);
  return {rows.begin() + static_cast<std::ptrdiff_t>(std::min(inSight, rows.size())), rows.end()};
}

// --- blocks

class Writer {
 public:
  Writer(const Report& report, const DrawnFigures& drawings)
      : report_(report), drawings_(drawings), names_(report.engines) {
    for (const Section& section : report.sections) taken_.insert(section.id);
  }

  void section(const Section& section) {
    if (section.folded) out_ += "<details class=\"section\"><summary>\n";
    heading(2, section.id, section.title);
    if (section.folded) out_ += "</summary>\n";
    blocks(section.blocks);
    if (section.folded) out_ += "</details>\n";
  }
  void blocks(const Blocks& all) {
    for (const Block& block : all)
      std::visit([this](const auto& part) { write(part); }, block.content);
  }
  std::string take() { return std::move(out_); }

 private:
  void heading(int level, const std::string& id, const std::string& text) {
    out_ += fmt::format(
        "<h{0} id=\"{1}\">{2}<a class=\"anchor\" href=\"#{1}\" aria-label=\"Link to this "
        "part\">#</a></h{0}>\n",
        level, escaped(id), mathHtml(text));
  }

  void write(const Heading& part) {
    const std::string slug = slugOf(part.text);
    std::string id = part.id;
    if (id.empty()) {
      id = slug;
      for (int k = 2; taken_.contains(id); ++k) id = fmt::format("{}-{}", slug, k);
    }
    taken_.insert(id);
    heading(3, id, part.text);
  }
  void write(const Paragraph& part) {
    if (part.text.empty()) return;
    const char* const styles[] = {"<p>", "<p class=\"small\">", "<p class=\"warning\">"};
    out_ += styles[static_cast<int>(part.style)] + mathHtml(part.text) + "</p>\n";
  }
  void write(const List& part) {
    if (part.items.empty()) return;
    out_ += "<ul>\n";
    for (const Item& item : part.items)
      out_ += fmt::format(
          "<li>{}{}</li>\n",
          item.lead.empty() ? "" : "<b>" + mathHtml(item.lead) + "</b>: ", mathHtml(item.text));
    out_ += "</ul>\n";
  }
  void write(const Code& part) { out_ += "<pre>" + escaped(part.text) + "</pre>\n"; }
  void write(const Details& part) {
    out_ += "<details><summary>" + mathHtml(part.summary) + "</summary>\n";
    blocks(part.blocks);
    out_ += "</details>\n";
  }
  void write(const Drawings& part) {
    if (drawings_.missing) return;
    std::string figures;
    for (const std::string& name : part.names) figures += htmlDrawing(report_, name, drawings_);
    const bool pictures =
        !part.names.empty() && findBy(report_.pictures, part.names.front(), &Picture::name);
    if (!figures.empty())
      out_ += part.side ? fmt::format("<div class=\"figures{}\">\n{}</div>\n",
                                      pictures ? " pictures" : "", figures)
                        : figures;
  }

  void write(const Table& table) {
    if (table.rows.empty()) return;
    out_ += fmt::format("<div class=\"scroll\"><table{}>\n<thead><tr>",
                        table.dense         ? " class=\"scores\""
                        : table.reach > 0.0 ? " class=\"forest\""
                                            : "");
    for (const Column& column : table.columns) {
      const bool engine = column.kind == Column::Kind::engine;
      out_ +=
          fmt::format("<th{}>{}</th>",
                      engine                                ? " class=\"engine\""
                      : column.kind == Column::Kind::number ? " class=\"n\""
                                                            : "",
                      engine                                 ? names_(column.name)
                      : column.kind == Column::Kind::margins ? htmlAxis(column.name, table.reach)
                                                             : mathHtml(column.name));
    }
    out_ += "</tr></thead>\n<tbody>\n";
    for (const TableRow& row : table.rows) {
      if (!row.group.empty())
        out_ += fmt::format("<tr class=\"group\"><th colspan=\"{}\">{}</th></tr>\n",
                            table.columns.size(), names_(row.group));
      out_ += row.id.empty() ? "<tr>" : fmt::format("<tr id=\"{}\">", escaped(row.id));
      for (std::size_t k = 0; k < row.cells.size(); ++k) cell(row.cells[k], k, table);
      out_ += "</tr>\n";
    }
    out_ += "</tbody></table></div>\n";
    write(Paragraph{table.note, Paragraph::Style::small});
  }

  void cell(const Cell& cell, std::size_t place, const Table& table) {
    using enum Column::Kind;
    const Column column = place < table.columns.size() ? table.columns[place] : Column("");
    const Column::Kind kind = column.kind;
    const std::string asks = table.reach > 0.0 && place > 0
                                 ? fmt::format(" data-asks=\"{}\"", escaped(column.name))
                                 : std::string();
    std::string classes = kind == number ? "n" : kind == remark ? "why" : "";
    const VerdictLook& look = lookOf(cell.verdict);
    if (cell.bar) {
      out_ += fmt::format("<td{}>{}</td>", asks, htmlBar(*cell.bar, table.reach, look.cssClass));
      return;
    }
    const bool coloured = cell.verdict || cell.marked;
    if (coloured) classes += std::string(" change ") + std::string(look.cssClass);
    std::string text = kind == engines ? names_(cell.text) : mathHtml(cell.text);
    if (cell.marked) text = std::string(look.mark) + " " + text;
    if (coloured) text = "<b>" + text + "</b>";
    text = linked(cell.link, text);
    for (const std::string& note : cell.notes) text += "<small>" + mathHtml(note) + "</small>";
    if (!cell.strip.empty()) {
      text += "<span class=\"strip\">";
      for (const Square& square : cell.strip)
        text += fmt::format(R"(<i class="{}" title="{}">{}</i>)", lookOf(square.verdict).cssClass,
                            escaped(square.title), lookOf(square.verdict).mark);
      text += "</span>";
    }
    out_ +=
        fmt::format("<{0}{1}{2}>{3}</{0}>", place == 0 ? "th" : "td",
                    classes.empty() ? classes : fmt::format(" class=\"{}\"", classes), asks, text);
  }

  const Report& report_;
  const DrawnFigures& drawings_;
  EngineNames names_;
  std::set<std::string> taken_;
  std::string out_;
};

std::string joined(const Names& parts) {
  std::string result;
  for (const std::string& part : parts)
    if (!part.empty()) result += (result.empty() ? "" : " · ") + part;
  return result;
}

std::string machineOf(const Report& report) {
  const Machine& machine = report.head.machine;
  return joined({machine.cpu, machine.cores > 0 ? counted(machine.cores, "core") : "", machine.os});
}

std::string contentsOf(const Report& report) {
  std::string links = "<nav>";
  for (const Section& section : report.sections)
    links += linked("#" + section.id,
                    mathHtml(section.shortTitle.empty() ? section.title : section.shortTitle));
  if (!report.head.setup.toml.empty()) links += linked("#case", "Case");
  if (!report.head.kind.empty()) links += linked("#rebuild", "Files");
  return links + "</nav>\n";
}

std::string notesOf(const Report& report) {
  if (report.notes.empty()) return {};
  std::string text = "<details class=\"summary\"><summary>Notes</summary>\n<ul>\n";
  for (const std::string& note : report.notes) text += "<li>" + mathHtml(note) + "</li>\n";
  return text + "</ul></details>\n";
}

/// Links to the files beside the page.
std::string filesOf(const Report& report, const DrawnFigures& drawings) {
  Names names;
  if (!drawings.ofSite) names.emplace_back("results.json");
  for (const auto& [name, content] : report.tables) names.push_back(name);
  names.emplace_back("summary.md");
  if (report.checks) names.emplace_back("junit.xml");
  const auto folder = drawings.folder.parent_path();
  for (const char* const name : {"plots/", "runs/", "snapshots/", "packings/"})
    if (!folder.empty() && std::filesystem::is_directory(folder / name)) names.emplace_back(name);
  for (std::string& name : names) name = linked(name, escaped(name));
  return "Made of, beside this page: " + listed(names) +
         (drawings.ofSite ? "." : "; results.json holds everything.");
}

/// From the document's first line to its title.
std::string htmlHead(const Report& report) {
  const std::string title = escaped(titleOf(report.head));
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n<p class=\"meta\">{2}</p>\n"
      "</header>\n",
      title, pageFile("style.css"),
      escaped(joined({report.head.kind.empty() ? "" : "crossgrain " + report.head.kind,
                      report.head.started,
                      report.elapsed ? "took " + readableDuration(report.elapsed) : "",
                      report.head.version.empty() ? "" : "version " + report.head.version,
                      machineOf(report)})));
}

/// The legend of the engines' colours.
std::string htmlLegend(const std::vector<EngineRow>& engines) {
  const EngineNames names(engines);
  std::string text = "<p class=\"legend\" id=\"legend\">";
  for (const EngineRow& engine : engines) text += "<span>" + names(engine.name) + "</span>";
  return text + "</p>\n";
}

/// The case, the files, and how to make the page again, to the document's last line.
std::string htmlFoot(const Report& report, const DrawnFigures& drawings) {
  const CaseHead& setup = report.head.setup;
  std::string text;
  if (!setup.toml.empty())
    text += fmt::format(
        "<details class=\"section\"><summary><h2 id=\"case\">{}</h2></summary>\n<p>All its "
        "<code>extends</code> merged{}.</p>\n<pre>{}</pre>\n</details>\n",
        mathHtml(report.caseHeading),
        setup.file.empty() ? "" : fmt::format(", from <code>{}</code>", escaped(setup.file)),
        escaped(setup.toml));
  if (!report.head.kind.empty()) {
    text +=
        "<details class=\"section\"><summary><h2 id=\"rebuild\">Files and rebuilding</h2>"
        "</summary>\n<p>" +
        filesOf(report, drawings);
    if (drawings.ofSite)
      text +=
          " The results folder has all the rest: results.json (everything), larger tables, scripts "
          "and data of the plots.";
    else if (!report.figures.empty())
      text +=
          " Each plot's script and data are in <code>plots/</code> beside its SVG and PDF; "
          "<code>gnuplot NAME.gp</code> there redraws it.";
    text += "</p>\n";
    if (!report.head.command.empty())
      text += "<p>These results came from</p>\n<pre>" + escaped(report.head.command) + "</pre>\n";
    text +=
        "<p>and this page is rebuilt from <code>results.json</code>, without running anything, "
        "by</p>\n<pre>crossgrain report DIR</pre>\n</details>\n";
  }
  return text +
         fmt::format(
             "<footer>{}</footer>\n<script>{}</script>\n</body>\n</html>\n",
             escaped(joined(
                 {report.head.version.empty() ? std::string() : "crossgrain " + report.head.version,
                  machineOf(report)})),
             pageFile("tables.js"));
}

}  // namespace

std::string base64(std::string_view bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string encoded;
  encoded.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = bytes.size() - k < 3 ? bytes.size() - k : 3;
    std::uint32_t group = 0;
    for (std::size_t b = 0; b < 3; ++b)
      group = group << 8 | (b < count ? static_cast<unsigned char>(bytes[k + b]) : 0u);
    for (std::size_t d = 0; d < 4; ++d)
      encoded += d <= count ? digits[group >> (18 - 6 * d) & 63u] : '=';
  }
  return encoded;
}

std::string htmlMatrix(const Overview& overview, const std::vector<EngineRow>& engines) {
  if (overview.rows.empty() || overview.columns.empty()) return {};
  const bool wrapped = overview.columns.size() > mostColumns;
  const bool tall = !wrapped && overview.rows.size() > mostRows;
  const EngineNames names(engines);
  std::string text = fmt::format(
      "<div class=\"scroll\" id=\"overview\"><table "
      "class=\"overview{}\"{}>\n<thead><tr><th>{}</th>",
      wrapped ? " many"
      : tall  ? " tall"
              : "",
      tall ? fmt::format(" style=\"--lines:{}\"", mostLines(overview.rows)) : "",
      mathHtml(overview.rowsAre));
  for (const OverviewColumn& column : overview.columns)
    text += fmt::format("<th title=\"{}\">{}</th>", escaped(column.asks),
                        linked(addressOf(column.anchor), mathHtml(column.name)));
  text += "</tr></thead>\n<tbody>\n";
  const std::set<const OverviewRow*> later = laterRows(overview);
  for (const OverviewRow& row : overview.rows) {
    text += later.contains(&row) ? "<tr class=\"more\"><th>" : "<tr><th>";
    text += (row.isEngine ? names(row.name) : mathHtml(row.name)) + "</th>";
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      text += matrixCell(overview, row.cells[k], overview.columns[k].name);
    text += "</tr>\n";
  }
  text += "</tbody></table>";
  if (!later.empty())
    text += fmt::format("<label class=\"more\"><input type=\"checkbox\"> all {} rows</label>",
                        overview.rows.size());
  text += "</div>\n" + marksOf(overview, wrapped) + "<section class=\"summary\">\n";
  for (const std::string& sentence : overview.conclusion)
    text += "<p class=\"lead\">" + mathHtml(sentence) + "</p>\n";
  return text + "</section>\n";
}

std::string html(const Report& report, const DrawnFigures& drawings) {
  const auto& missing = drawings.missing;
  std::string text =
      htmlHead(report) + htmlMatrix(report.overview, report.engines) + notesOf(report);
  if (missing) text += "<p class=\"warning\">" + escaped(*missing) + "</p>\n";
  if (report.engineColours && !missing && !report.figures.empty() && report.engines.size() > 1)
    text += htmlLegend(report.engines);
  text += contentsOf(report);
  Writer writer(report, drawings);
  for (const Section& section : report.sections) writer.section(section);
  return text + writer.take() + htmlFoot(report, drawings);
}

}  // namespace crossgrain::reports
