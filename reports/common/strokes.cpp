#include "reports/common/strokes.hpp"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>

namespace crossgrain::reports {

namespace {

/// At most two decimals and no trailing zeros.
std::string shortNumber(double value) {
  std::string result = fmt::format("{:.2f}", value);
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result == "-0" ? "0" : result;
}

double channel(const std::string& colour, std::size_t index) {
  return std::stoi(colour.substr(1 + 2 * index, 2), nullptr, 16) / 255.0;
}

/// PDF's operators of a page: colour, width, then a path to stroke.
std::string pdfContent(const Drawing& drawing, double points) {
  const double scale = points / (2.0 * drawing.halfWidth);
  const auto place = [&](double v) { return shortNumber((v + drawing.halfWidth) * scale); };
  std::string content = "1 J\n";
  for (const StrokeGroup& group : drawing.groups) {
    content += fmt::format("{:.3f} {:.3f} {:.3f} RG {} w\n", channel(group.colour, 0),
                           channel(group.colour, 1), channel(group.colour, 2),
                           shortNumber(group.width * scale));
    for (const Stroke& s : group.strokes)
      content +=
          fmt::format("{} {} m {} {} l\n", place(s.x1), place(s.y1), place(s.x2), place(s.y2));
    content += "S\n";
  }
  return content;
}

}  // namespace

std::string toSvg(const Drawing& drawing, double size, const std::string& title) {
  const double scale = size / (2.0 * drawing.halfWidth);
  const auto x = [&](double v) { return shortNumber((v + drawing.halfWidth) * scale); };
  const auto y = [&](double v) { return shortNumber((drawing.halfWidth - v) * scale); };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{0}\" viewBox=\"0 0 {0} "
      "{0}\">\n<title>{1}</title>\n<g fill=\"none\" stroke-linecap=\"round\">\n",
      size, kainjow::mustache::html_escape(title));
  for (const StrokeGroup& group : drawing.groups) {
    svg += fmt::format("<path stroke=\"{}\" stroke-width=\"{}\" d=\"", group.colour,
                       shortNumber(group.width * scale));
    for (const Stroke& s : group.strokes) {
      svg += "M" + x(s.x1) + " " + y(s.y1);
      svg += s.x1 == s.x2 && s.y1 == s.y2 ? "h0" : "L" + x(s.x2) + " " + y(s.y2);
    }
    svg += "\"/>\n";
  }
  return svg + "</g>\n</svg>\n";
}

std::string toPdf(const Drawing& drawing, double size) {
  const double points = size * 72.0 / 96.0;
  const std::string content = pdfContent(drawing, points);
  const std::vector<std::string> objects = {
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {0} {0}] /Contents 4 0 R >>",
                  points),
      fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content)};
  std::string pdf = "%PDF-1.4\n";
  std::string places;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    places += fmt::format("{:010} 00000 n \n", pdf.size());
    pdf += fmt::format("{} 0 obj\n{}\nendobj\n", k + 1, objects[k]);
  }
  const std::size_t table = pdf.size();
  return pdf + fmt::format(
                   "xref\n0 {0}\n0000000000 65535 f \n{1}trailer\n<< /Size {0} /Root 1 0 R "
                   ">>\nstartxref\n{2}\n%%EOF\n",
                   objects.size() + 1, places, table);
}

}  // namespace crossgrain::reports
