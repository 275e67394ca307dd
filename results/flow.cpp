#include <algorithm>
#include <cmath>

#include "results/compare.hpp"

namespace crossgrain::inline results {

std::optional<double> differenceFromSlicing(const std::vector<RevCurve>& curves,
                                            std::string_view field, std::string_view method,
                                            double width) {
  const auto meanOf = [&](std::string_view by, double r) -> std::optional<double> {
    for (const RevCurve& curve : curves) {
      if (curve.field != field || curve.method != by || curve.r != r) continue;
      const auto at =
          static_cast<std::size_t>(std::ranges::find(curve.width, width) - curve.width.begin());
      const auto mean = at < curve.mean.size() ? curve.mean[at] : std::nullopt;
      return mean && std::isfinite(*mean) ? mean : std::nullopt;
    }
    return std::nullopt;
  };
  double difference = 0.0, scale = 0.0;
  for (const RevCurve& slicing : curves) {
    if (slicing.field != field || slicing.method != "slicing") continue;
    const auto plain = meanOf("slicing", slicing.r), other = meanOf(method, slicing.r);
    if (!plain || !other) continue;
    difference += (*other - *plain) * (*other - *plain);
    scale += *plain * *plain;
  }
  if (scale == 0.0) return std::nullopt;
  return std::sqrt(difference / scale);
}

const Profile* profileOf(const std::vector<Profile>& profiles, std::string_view field) {
  const auto found = std::ranges::find(profiles, field, &Profile::field);
  return found == profiles.end() ? nullptr : &*found;
}

const Profile* profileOf(const std::vector<Profile>& profiles, std::string_view method,
                         std::string_view field) {
  const auto found = std::ranges::find_if(profiles, [&](const Profile& profile) {
    return profile.field == field && profile.method == method;
  });
  return found == profiles.end() ? nullptr : &*found;
}

}  // namespace crossgrain::inline results
