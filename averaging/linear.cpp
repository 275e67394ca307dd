#include "averaging/linear.hpp"

#include <cmath>
#include <limits>

namespace crossgrain::inline averaging {

namespace {

void append(const Linear& x, double factor, Linear& sum) {
  for (const auto& [index, slope] : x.slopes) sum.slopes.emplace_back(index, factor * slope);
}

}  // namespace

Linear chained(double value, const Linear& x, double dx) {
  Linear result(value);
  append(x, dx, result);
  return result;
}

Linear chained(double value, const Linear& x, double dx, const Linear& y, double dy) {
  Linear result(value);
  result.slopes.reserve(x.slopes.size() + y.slopes.size());
  append(x, dx, result);
  append(y, dy, result);
  return result;
}

Linear length(const Linear& x, const Linear& y) {
  const double l = std::hypot(x.value, y.value);
  if (l == 0.0) return 0.0;
  return chained(l, x, x.value / l, y, y.value / l);
}

Linear direction(const Linear& x, const Linear& y) {
  const double square = x.value * x.value + y.value * y.value;
  if (square == 0.0) return std::numeric_limits<double>::quiet_NaN();
  return chained(std::atan2(y.value, x.value), x, -y.value / square, y, x.value / square);
}

Linear cos(const Linear& x) {
  return chained(std::cos(x.value), x, -std::sin(x.value));
}

Linear sin(const Linear& x) {
  return chained(std::sin(x.value), x, std::cos(x.value));
}

Linear trace(const LinearTensor& t) {
  return t.rr + t.pp;
}

Linear deviator(const LinearTensor& t) {
  return length(t.rr - t.pp, t.rp + t.pr);
}

Linear axis(const LinearTensor& t) {
  return 0.5 * direction(t.rr - t.pp, t.rp + t.pr);
}

LinearTensor inverse(const LinearTensor& t) {
  Linear determinant = t.rr * t.pp - t.rp * t.pr;
  const double scale = trace(t).value;
  if (!(std::abs(determinant.value) > 1e-12 * scale * scale))
    determinant = std::numeric_limits<double>::quiet_NaN();
  return {t.pp / determinant, -t.rp / determinant, -t.pr / determinant, t.rr / determinant};
}

LinearTensor operator*(const LinearTensor& s, const LinearTensor& t) {
  return {s.rr * t.rr + s.rp * t.pr, s.rr * t.rp + s.rp * t.pp, s.pr * t.rr + s.pp * t.pr,
          s.pr * t.rp + s.pp * t.pp};
}

}  // namespace crossgrain::inline averaging
