#include "results/thesis_formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "cases/thesis_claims.hpp"

namespace crossgrain::inline results {
namespace {

using Evaluator = Formula::Evaluator;

std::optional<double> finiteOf(double x) {
  return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

std::optional<double> single(const FormulaValue& value) {
  if (value.perRing) throw std::logic_error("formula: rings where a number is wanted");
  return value.values.front();
}

double combine(char op, double x, double y) {
  return op == '+' ? x + y : op == '-' ? x - y : op == '*' ? x * y : x / y;
}

FormulaValue combine(char op, const FormulaValue& a, const FormulaValue& b) {
  const bool perRing = a.perRing || b.perRing;
  const std::size_t count =
      perRing ? std::max(a.perRing ? a.values.size() : 0, b.perRing ? b.values.size() : 0) : 1;
  if (a.perRing && b.perRing && a.values.size() != b.values.size())
    throw std::logic_error("formula: rings of two widths");
  FormulaValue result{Numbers(count), perRing, a.exact && b.exact, Numbers(count)};
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = a.perRing ? k : 0, j = b.perRing ? k : 0;
    if (!a.values[i] || !b.values[j]) continue;
    const double x = *a.values[i], y = *b.values[j];
    result.values[k] = finiteOf(combine(op, x, y));
    const auto error = a.exact ? b.errors[j] : b.exact ? a.errors[i] : std::nullopt;
    if (!error) continue;
    if (op == '*') result.errors[k] = std::abs(a.exact ? x : y) * *error;
    if (op == '/')
      result.errors[k] = a.exact ? std::abs(x) * *error / (y * y) : *error / std::abs(y);
  }
  return result;
}

using Function = double (*)(double);
const std::map<std::string, Function, std::less<>>& functions() {
  static const std::map<std::string, Function, std::less<>> all = {
      {"abs", [](double x) { return std::abs(x); }},
      {"ln", [](double x) { return x > 0.0 ? std::log(x) : NAN; }},
      {"lg", [](double x) { return x > 0.0 ? std::log10(x) : NAN; }},
      {"exp", [](double x) { return std::exp(x); }},
      {"sqrt", [](double x) { return std::sqrt(x); }},
      {"cos", [](double x) { return std::cos(x); }},
      {"positive", [](double x) { return x > 0.0 ? x : NAN; }}};
  return all;
}

std::optional<double> rmsOf(const std::vector<RingValue>& rings) {
  if (rings.empty()) return std::nullopt;
  double squares = 0.0;
  for (const RingValue& each : rings) squares += each.value * each.value;
  return std::sqrt(squares / static_cast<double>(rings.size()));
}

using OverRings = std::optional<double> (*)(std::vector<RingValue> rings);
const std::map<std::string, OverRings, std::less<>>& ringFunctions() {
  using Rings = std::vector<RingValue>;
  using Maybe = std::optional<double>;
  static const std::map<std::string, OverRings, std::less<>> all = {
      {"mean", [](Rings rings) { return meanOf(rings); }},
      {"median", [](Rings rings) { return medianOf(rings); }},
      {"rms", [](Rings rings) { return rmsOf(rings); }},
      {"scatter",
       [](Rings rings) -> Maybe {
         if (rings.size() < 2) return std::nullopt;
         const double middle = *meanOf(rings);
         for (RingValue& each : rings) each.value -= middle;
         return finiteOf(*rmsOf(rings) / std::abs(middle));
       }},
      {"max",
       [](Rings rings) -> Maybe {
         if (rings.empty()) return std::nullopt;
         return std::ranges::max(rings, {}, &RingValue::value).value;
       }},
      {"min",
       [](Rings rings) -> Maybe {
         if (rings.empty()) return std::nullopt;
         return std::ranges::min(rings, {}, &RingValue::value).value;
       }},
      {"axis", [](Rings rings) -> Maybe {
         if (rings.empty()) return std::nullopt;
         double x = 0.0, y = 0.0;
         for (const RingValue& each : rings) {
           x += std::cos(2.0 * each.value);
           y += std::sin(2.0 * each.value);
         }
         return 0.5 * std::atan2(y, x);
       }}};
  return all;
}

std::size_t countOf(const FormulaContext& context) {
  return context.profiles.empty() ? 0 : context.profiles.front().mean.size();
}

std::vector<RingValue> placesOf(const FormulaContext& context) {
  return ringPlaces(context.at.setup->cell, countOf(context));
}

std::vector<RingValue> ringsIn(const FormulaValue& value, const FormulaContext& context,
                               const RingSpan& span) {
  std::vector<RingValue> rings;
  for (RingValue each : placesOf(context)) {
    if (each.rTilde < span.from || each.rTilde >= span.to || !value.values[each.ring]) continue;
    each.value = *value.values[each.ring];
    rings.push_back(each);
  }
  return rings;
}

std::optional<FormulaValue> numberOfRun(std::string_view name, const CaseRun& at) {
  const CouetteCell& cell = at.setup->cell;
  if (name == "pi") return chosen(std::numbers::pi);
  if (name == "d") return chosen(cell.diameter);
  if (name == "R_i") return chosen(cell.innerRadius);
  if (name == "R_o") return chosen(cell.outerRadius);
  if (name == "height") return chosen(cell.height);
  if (name == "omega") return chosen(cell.omega);
  if (name == "kn") return chosen(at.setup->kn);
  if (name == "kt") return uncertain(caseConstants(at.setup->caseToml).kt);
  const auto& stats = at.run->run.stats;
  const auto& effective = at.run->run.effective;
  if (name == "cpu_s") return uncertain(stats ? std::optional(stats->cpuSeconds) : std::nullopt);
  if (name == "steps")
    return uncertain(stats ? std::optional(static_cast<double>(stats->steps)) : std::nullopt);
  if (name == "dt") return uncertain(effective ? std::optional(effective->dt) : std::nullopt);
  return std::nullopt;
}

FormulaValue valueOf(const std::string& name, const FormulaContext& context) {
  if (context.named)
    if (auto found = context.named(name)) return *std::move(found);
  if (auto found = numberOfRun(name, context.at)) return *std::move(found);
  FormulaValue rings{Numbers(countOf(context)), true, false, Numbers(countOf(context))};
  if (name == "r" || name == "r_tilde") {
    for (const RingValue& each : placesOf(context))
      rings.values[each.ring] = name == "r" ? each.r : each.rTilde;
    return rings;
  }
  if (!isReadByFormulas(name))
    throw std::logic_error(fmt::format("formula: nobody knows what {} is", name));
  const Profile* const profile = context.method.empty()
                                     ? profileOf(context.profiles, name)
                                     : profileOf(context.profiles, context.method, name);
  if (!profile) return rings;
  for (std::size_t k = 0; k < rings.values.size() && k < profile->mean.size(); ++k)
    if (const auto& value = profile->mean[k]) {
      rings.values[k] = finiteOf(*value);
      if (k < profile->standardError.size()) rings.errors[k] = profile->standardError[k];
    }
  return rings;
}

/// @throws std::logic_error for a name that no number of a span has
std::optional<double> ThesisSpan::*numberOfSpans(std::string_view name) {
  const auto found = std::ranges::find(spanNumbers, name, &SpanNumber::name);
  if (found == std::end(spanNumbers))
    throw std::logic_error(fmt::format("no number of a span: {}", name));
  return found->of;
}

/// Mean over the spans of the averaged time, by their lengths.
std::optional<double> averagedOf(const CaseRun& at, std::optional<double> ThesisSpan::*quantity) {
  double sum = 0.0, length = 0.0;
  for (const ThesisSpan& span : at.run->history) {
    constexpr double rounding = 1e-6;  // between times that were typed in [rotations]
    if (span.from < at.setup->settleRotations - rounding || !(span.*quantity)) continue;
    sum += (span.to - span.from) * *(span.*quantity);
    length += span.to - span.from;
  }
  return finiteOf(sum / length);
}

/// Compiles a text, from left to right.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Evaluator whole() {
    Evaluator all = sum();
    if (skip() != '\0') fail();
    return all;
  }

 private:
  [[noreturn]] void fail() const {
    throw std::logic_error(fmt::format("no formula: {} (at {})", text_, at_));
  }
  char skip() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char wanted) {
    if (skip() != wanted) return false;
    ++at_;
    return true;
  }
  void want(char wanted) {
    if (!take(wanted)) fail();
  }
  std::string word() {
    skip();
    const std::size_t from = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    if (at_ == from) fail();
    return std::string(text_.substr(from, at_ - from));
  }

  Evaluator sum() {
    return chain("+-", [this] { return product(); });
  }
  Evaluator product() {
    return chain("*/", [this] { return factor(); });
  }

  template <typename Part>
  Evaluator chain(std::string_view operators, Part part) {
    Evaluator left = part();
    while (operators.find(skip()) != std::string_view::npos && skip() != '\0') {
      const char op = text_[at_++];
      left = [op, left = std::move(left), right = part()](const FormulaContext& context) {
        return combine(op, left(context), right(context));
      };
    }
    return left;
  }

  Evaluator factor() {
    if (take('-'))
      return [of = factor()](const FormulaContext& context) {
        return combine('*', chosen(-1.0), of(context));
      };
    if (take('(')) {
      Evaluator inside = sum();
      want(')');
      return inside;
    }
    if (std::isdigit(static_cast<unsigned char>(skip())) != 0) {
      double number = 0.0;
      const auto [end, error] =
          std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
      if (error != std::errc()) fail();
      at_ = static_cast<std::size_t>(end - text_.data());
      return [number](const FormulaContext&) { return chosen(number); };
    }
    const std::string name = word();
    if (take('(')) return call(name);
    return [name](const FormulaContext& context) { return valueOf(name, context); };
  }

  Evaluator call(const std::string& name) {
    if (name == "fit" || name == "head" || name == "averaged") return ofRun(name);
    if (name == "by") {
      const std::string method = word();
      want(',');
      return close([method, of = sum()](const FormulaContext& context) {
        FormulaContext other = context;
        other.method = method;
        return of(other);
      });
    }
    if (name == "fine")
      return close([of = sum()](const FormulaContext& context) {
        const auto fewest = context.named ? context.named("fewest_fine") : std::nullopt;
        const RingAverages* const fine =
            finestOf(*context.at.run, fewest ? fewest->values.front().value_or(0.0) : 0.0);
        static const std::vector<Profile> none;
        return of({context.at, fine ? fine->profiles : none, context.method, context.named});
      });
    if (name == "where") return filter();
    if (const auto found = functions().find(name); found != functions().end())
      return close(
          [of = sum(), function = found->second,
           keepsError = name == "abs" || name == "positive"](const FormulaContext& context) {
            FormulaValue value = of(context);
            for (auto& each : value.values)
              if (each) each = finiteOf(function(*each));
            if (!keepsError) value.errors.assign(value.values.size(), std::nullopt);
            return value;
          });
    if (const auto found = ringFunctions().find(name); found != ringFunctions().end())
      return overRings(found->second);
    if (name == "ring" || name == "near" || name == "last") return oneRing(name);
    fail();
  }

  Evaluator close(Evaluator evaluator) {
    want(')');
    return evaluator;
  }

  Evaluator ofRun(const std::string& kind) {
    const std::string name = word();
    if (kind == "averaged")
      return close([quantity = numberOfSpans(name)](const FormulaContext& context) {
        return uncertain(averagedOf(context.at, quantity));
      });
    if (kind == "fit")
      return close([name](const FormulaContext& context) {
        const FitRow* const fit = fitOf(*context.at.run, name);
        FormulaValue value = uncertain(fit ? fit->value : std::nullopt);
        if (fit) value.errors.front() = fit->standardError;
        return value;
      });
    return close([name](const FormulaContext& context) {
      const std::vector<HeadNumber>& head = context.at.run->run.head;
      const auto found = std::ranges::find(head, name, &HeadNumber::name);
      return uncertain(found == head.end() ? std::nullopt : found->value);
    });
  }

  Evaluator overRings(OverRings function) {
    Evaluator of = sum();
    std::function<RingSpan(const FormulaContext&)> span = [](const FormulaContext&) {
      return RingSpan{};
    };
    if (take(',')) span = zone();
    return close(
        [function, of = std::move(of), span = std::move(span)](const FormulaContext& context) {
          const FormulaValue value = of(context);
          if (!value.perRing) throw std::logic_error("formula: a number where rings are wanted");
          return uncertain(function(ringsIn(value, context, span(context))));
        });
  }

  std::function<RingSpan(const FormulaContext&)> zone() {
    const auto ofNames = [](const char* from, const char* to) {
      return [=](const FormulaContext& context) {
        return RingSpan{from ? single(valueOf(from, context)).value() : 0.0,
                        single(valueOf(to, context)).value()};
      };
    };
    const std::size_t before = at_;
    if (std::isdigit(static_cast<unsigned char>(skip())) == 0) {
      const std::string name = word();
      if (name == "band") return ofNames(nullptr, "band_to");
      if (name == "inside_band") return ofNames("first_layer_to", "band_to");
      if (name == "bulk") return ofNames("bulk_from", "bulk_to");
      if (name == "off_walls")
        return [](const FormulaContext& context) {
          const std::size_t rings = countOf(context);
          if (rings < 3) return RingSpan{0.0, 0.0};
          const CouetteCell& cell = context.at.setup->cell;
          const double width =
              (cell.outerRadius - cell.innerRadius) / static_cast<double>(rings) / cell.diameter;
          return RingSpan{width, width * static_cast<double>(rings - 1)};
        };
      at_ = before;
    }
    Evaluator from = sum();
    want(',');
    return [from = std::move(from), to = sum()](const FormulaContext& context) {
      return RingSpan{single(from(context)).value(), single(to(context)).value()};
    };
  }

  Evaluator filter() {
    Evaluator of = sum();
    want(',');
    Evaluator by = sum();
    want(',');
    return close(
        [of = std::move(of), by = std::move(by), limit = sum()](const FormulaContext& context) {
          FormulaValue value = of(context);
          const FormulaValue other = by(context);
          const double least = single(limit(context)).value();
          for (std::size_t k = 0; k < value.values.size(); ++k)
            if (!other.values.at(k) || *other.values[k] < least) value.values[k].reset();
          return value;
        });
  }

  Evaluator oneRing(const std::string& kind) {
    Evaluator of = sum(), place;
    if (kind != "last") {
      want(',');
      place = sum();
    }
    return close([=](const FormulaContext& context) {
      const FormulaValue value = of(context);
      std::optional<std::size_t> ring;
      if (kind == "ring") ring = static_cast<std::size_t>(single(place(context)).value());
      if (kind == "near") ring = ringNear(context.at, single(place(context)).value());
      if (kind == "last" && !value.values.empty()) ring = value.values.size() - 1;
      FormulaValue result = uncertain({});
      if (!ring || *ring >= value.values.size()) return result;
      result.values.front() = value.values[*ring];
      result.errors.front() = value.errors[*ring];
      return result;
    });
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

Formula::Formula(std::string_view text) : text_(text), evaluate_(Parser(text_).whole()) {}

std::optional<Measured> Formula::number(const FormulaContext& context) const {
  const FormulaValue value = evaluate_(context);
  const auto found = single(value);
  if (!found) return std::nullopt;
  return Measured(*found, value.errors.front());
}

FormulaValue Formula::rings(const FormulaContext& context) const {
  const FormulaValue value = evaluate_(context);
  if (!value.perRing) throw std::logic_error("formula: a number where rings are wanted: " + text_);
  return value;
}

FormulaValue uncertain(std::optional<double> value) {
  if (value) value = finiteOf(*value);
  return {{value}, false, false, {std::nullopt}};
}

FormulaValue chosen(double value) {
  return {{value}, false, true, {std::nullopt}};
}

const RingAverages* finestOf(const ThesisRun& run, double fewest) {
  const RingAverages* finest = nullptr;
  for (const RingAverages& each : run.finer)
    if (each.rings >= fewest && (!finest || each.rings > finest->rings)) finest = &each;
  return finest;
}

}  // namespace crossgrain::inline results
