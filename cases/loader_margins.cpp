#include "cases/couette.hpp"
#include "cases/loader_sections.hpp"

namespace crossgrain::inline cases {
namespace {

const Section<MarginInput>& marginKeys(bool shares) {
  const auto table = [](bool withShares) {
    const char* const standard = withShares ? "one of the three" : "one of the two";
    std::vector<Key<MarginInput>> keys = {
        key("relative", &MarginInput::relative, positive(), "").listed(standard),
        key("absolute", &MarginInput::absolute, positive(), "").listed(standard, "its own")};
    if (withShares) {
      Names names;
      for (const Scale& scale : scales()) names.emplace_back(scale.name);
      keys.push_back(key("share", &MarginInput::share, positive(),
                         "of a scale of the case (Margins), rounded to two digits")
                         .listed(standard));
      keys.push_back(
          key("of", &MarginInput::of, names, "in the unit of the quantity").listed("with share"));
    }
    keys.push_back(need("why", &MarginInput::why, Sentence{"must give the reason"}, ""));
    return Section<MarginInput>({}, std::move(keys));
  };
  static const Section<MarginInput> plain = table(false), withShares = table(true);
  return shares ? withShares : plain;
}

/// A share of one of the case's own scales.
void setShare(const Reader& in, const MarginInput& input, const Judged& judged, const Case& setup,
              Margin& margin) {
  const Scale& scale = *std::ranges::find(scales(), input.of, &Scale::name);
  in.check(scale.unit == judged.unit, "of", "is in {}, and {} in {}", scale.unit, judged.name,
           judged.unit);
  const double whole = scale.of(setup);
  in.check(whole > 0.0, "of", "is zero in this case");
  margin.scale = input.of;
  margin.value = fractionOf(scale, input.share, setup);
  margin.why = fmt::format("{:g} of {} ({} = {:.4g} {}): ", input.share, scale.name, scale.meaning,
                           whole, scale.unit);
}

}  // namespace

Margin marginOf(Reader& in, const MarginInput& input, const Judged& judged, const Case* setup) {
  Margin margin;
  if (in.has("share") != in.has("of"))
    in.failMissing(in.has("of") ? "share" : "of", "a margin of a share says of what");
  const std::string given = in.onlyOne({"relative", "absolute", "share"});
  if (given.empty())
    in.failMissing("relative", setup ? "or absolute, or share and of: a margin has one of them"
                                     : "or absolute: a margin has one of them");
  margin.relative = given == "relative";
  margin.value = margin.relative ? input.relative : input.absolute;
  if (given == "share") setShare(in, input, judged, *setup, margin);
  if (judged.byRatio)
    in.check(*judged.byRatio == margin.relative, given, "{} is compared by its {}: give {}",
             judged.name, *judged.byRatio ? "ratio" : "difference",
             *judged.byRatio ? "relative" : "absolute, or share and of");
  margin.why += input.why;
  return margin;
}

std::map<std::string, Margin> readMargins(Reader in, const std::vector<Judged>& list,
                                          const Case* setup) {
  std::map<std::string, Margin> margins;
  for (const Judged& judged : list) {
    Reader one = in.section(judged.name);
    if (!in.has(judged.name)) continue;
    MarginInput input;
    marginKeys(setup != nullptr).read(one, input);
    margins[judged.name] = marginOf(one, input, judged, setup);
  }
  in.finish();
  return margins;
}

SectionInfo marginSection(SectionInfo info, const std::string& name, std::string meaning,
                          const std::string& relativeTo, bool shares) {
  info.keys.push_back({name, "", "–", "", meaning + ": a table of the keys below"});
  for (KeyInfo one : marginKeys(shares).info().keys) {
    if (one.name == "relative") one.meaning = relativeTo;
    one.name = name + "." + one.name;
    info.keys.push_back(one);
  }
  return info;
}

std::vector<Judged> judgedFields(std::span<const FieldSpec> fields) {
  std::vector<Judged> judged;
  for (const FieldSpec& field : fields)
    judged.push_back({std::string(field.name), std::string(field.unit)});
  return judged;
}

}  // namespace crossgrain::inline cases
