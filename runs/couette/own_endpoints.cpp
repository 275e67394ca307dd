#include "runs/couette/own_endpoints.hpp"

#include <algorithm>

#include "runs/couette/endpoint_values.hpp"
#include "runs/couette/frame.hpp"
#include "runs/couette/summary.hpp"

namespace crossgrain::inline runs {

namespace {

using Value = std::optional<double>;

/// Slope of the straight line through the points that are there, by least squares:
/// Σ (x − x̄)(y − ȳ) / Σ (x − x̄)².
Value slopeOf(const std::vector<double>& x, const Numbers& y) {
  double count = 0.0, meanX = 0.0, meanY = 0.0;
  const std::size_t size = std::min(x.size(), y.size());
  for (std::size_t k = 0; k < size; ++k)
    if (y[k]) {
      count += 1.0;
      meanX += x[k];
      meanY += *y[k];
    }
  if (count < 2.0) return {};
  meanX /= count;
  meanY /= count;
  double both = 0.0, square = 0.0;
  for (std::size_t k = 0; k < size; ++k)
    if (y[k]) {
      both += (x[k] - meanX) * (*y[k] - meanY);
      square += (x[k] - meanX) * (x[k] - meanX);
    }
  return square > 0.0 ? Value(both / square) : Value{};
}

Value ofSeries(const std::string& name, Reduction reduction, const CouetteRun& run) {
  if (!run.series) return {};
  const Numbers& values = valuesOf(*run.series, name);
  if (reduction == Reduction::rate)
    return slopeOf(presentNumbers(valuesOf(*run.series, "t_s")), values);
  if (reduction == Reduction::end) return values.empty() ? Value{} : values.back();
  // As they are, not estimated: a mean of what one run showed.
  const std::vector<double> present = presentNumbers(values);
  if (present.empty()) return {};
  double sum = 0.0;
  for (const double value : present) sum += value;
  return sum / static_cast<double>(present.size());
}

Value reduced(const std::string& quantity, const OwnEndpoint& how, const Case& setup,
              const CouetteRun& run) {
  const auto numbers = regionNumbers();
  if (std::ranges::find(numbers, quantity, &RegionNumber::name) != numbers.end())
    return ofSeries(quantity, how.reduction, run);
  const Profile* profile = profileOf(run.profiles, setup.averaging.methods.front(), quantity);
  if (!profile) return {};
  const auto bin = static_cast<std::size_t>(how.bin);
  switch (how.reduction) {
    case Reduction::bin:
      return bin < profile->mean.size() ? profile->mean[bin] : Value{};
    case Reduction::slope:
      return slopeOf(placesOf(setup).r, profile->mean);
    default:
      return cellMean(setup, run, quantity);
  }
}

}  // namespace

std::optional<double> ownEndpointOf(const OwnEndpoint& endpoint, const Case& setup,
                                    const CouetteRun& run) {
  const Value value = reduced(endpoint.quantity, endpoint, setup, run);
  if (endpoint.per.empty()) return value;
  const Value below = reduced(endpoint.per, endpoint, setup, run);
  return value && below && *below != 0.0 ? Value(*value / *below) : Value{};
}

}  // namespace crossgrain::inline runs
