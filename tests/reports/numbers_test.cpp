#include "support/numbers.hpp"

#include <gtest/gtest.h>

#include "reports/common/text.hpp"
#include "reports/render/html.hpp"

namespace crossgrain::reports {
namespace {

using namespace std::string_literals;

TEST(Numbers, Readable_HasThreeSignificantDigits) {
  EXPECT_EQ(readable(0.0), "0");
  EXPECT_EQ(readable(0.0123456), "0.0123");
  EXPECT_EQ(readable(-12.3456), "−12.3");
  EXPECT_EQ(readable(9.996), "10.0");
  EXPECT_EQ(readable(1234.4), "1234");
  EXPECT_EQ(readable(123456.0), "123\u202f456");
  EXPECT_EQ(readable(1.2345e-5), "1.23×10⁻⁵");
  EXPECT_EQ(readable(9.999e-5), "1.00×10⁻⁴");
  EXPECT_EQ(readable(-2.5e12), "−2.50×10¹²");
  EXPECT_EQ(readable(std::nullopt), "–");
}

TEST(Numbers, Error_HasTwoDigitsAndTheValueStopsWithThem) {
  EXPECT_EQ(readable(0.24178, 0.0131), "0.242\u00a0±\u00a00.013");
  EXPECT_EQ(readable(1487.0, 61.0), "1487\u00a0±\u00a061");
  EXPECT_EQ(readable(1.234e-5, 4.8e-7), "(1.234\u00a0±\u00a00.048)×10⁻⁵");
  EXPECT_EQ(readable(0.5, std::nullopt), "0.500");
  EXPECT_EQ(readable(std::nullopt, 0.5), "–");
  // An error far below the value has digits of its own: never ± 0.
  EXPECT_EQ(readable(0.018378, 2.04e-10), "0.0183780\u00a0±\u00a02.0×10⁻¹⁰");
  EXPECT_EQ(readable(0.018378, 4.2e-7), "0.0183780\u00a0±\u00a04.2×10⁻⁷");
  EXPECT_EQ(readable(-3.2e-7, 1.1e-18), "−3.20000×10⁻⁷\u00a0±\u00a01.1×10⁻¹⁸");
  // Rounding of the same number twice is no error.
  EXPECT_EQ(readable(0.6891667, 5.7e-17), "0.689");
  EXPECT_EQ(readable(123456.0, 0.012), "123\u202f456\u00a0±\u00a00.012");
  EXPECT_EQ(readable(1e-12, 0.5), "0.00\u00a0±\u00a00.50");
  EXPECT_EQ(readableDifference(0.24178, 0.0131), "+0.242\u00a0±\u00a00.013");
  EXPECT_EQ(readableDifference(-0.24178, 0.0131), "−0.242\u00a0±\u00a00.013");
}

TEST(Numbers, Pair_HasDigitsUntilTheTwoDiffer) {
  EXPECT_EQ(readablePair(586507.0, 586507.3), std::pair("586\u202f507.0"s, "586\u202f507.3"s));
  EXPECT_EQ(readablePair(206.4, 643.1), std::pair("206"s, "643"s));
  EXPECT_EQ(readablePair(0.1, 0.1 + 1e-16), std::pair("0.100"s, "0.100"s));
  EXPECT_EQ(readablePair(std::nullopt, 2.0), std::pair("–"s, "2.00"s));
}

TEST(Numbers, Interval_HasTheDigitsOfItsWidth) {
  const auto difference = [](double value, std::optional<double> low, std::optional<double> high) {
    return readableInterval(value, low, high, "", Sign::ofAll);
  };
  EXPECT_EQ(difference(437.2, 420.4, 454.1), "+437 (+420 to +454)");
  EXPECT_EQ(difference(-0.00829, -0.0155, -0.000782), "−0.0083 (−0.0155 to −0.0008)");
  EXPECT_EQ(difference(1e-9, -3e-8, 3.2e-8), "+0.1 (−3.0 to +3.2)×10⁻⁸");
  EXPECT_EQ(difference(0.25, std::nullopt, std::nullopt), "+0.250");
  EXPECT_EQ(readableInterval(48.7, 46.1, 52.2, " margins"), "48.7 margins (46.1 to 52.2)");
  EXPECT_EQ(readableInterval(4e-8, 1e-8, 8e-8, " %"), "4.0 (1.0 to 8.0)×10⁻⁸ %");
}

TEST(Numbers, IntervalOfOneNumber_IsThatNumber) {
  EXPECT_EQ(readableInterval(49.0, 49.0, 49.0, " margins"), "49.0 margins");
  EXPECT_EQ(readableInterval(49.0, 49.0, 49.0 + 1e-13, " margins"), "49.0 margins");
  EXPECT_EQ(readableInterval(std::nullopt, 1.0, 2.0, " m"), "–");
  EXPECT_EQ(readableRange(49.0, 49.0), "49.0");
  EXPECT_EQ(readableRange(49.02, 49.04), "49.02 to 49.04");
  EXPECT_EQ(withEnds("1.2 ms", "1.2 ms", "1.2 ms"), "1.2 ms");
  EXPECT_EQ(withEnds("1.2 ms", "1.1 ms", "1.3 ms"), "1.2 ms (1.1 ms to 1.3 ms)");
}

TEST(Numbers, Interval_HasDigitsUntilTheValueIsNoEnd) {
  EXPECT_EQ(readableInterval(2.5, 0.0, 1520.0, " %"), "2 % (0 to 1520)");
  EXPECT_EQ(readableInterval(0.3, 0.0, 1520.0, " %"), "0.3 % (0.0 to 1520.0)");
}

TEST(Numbers, Setting_KeepsItsDigits) {
  EXPECT_EQ(readableSetting(352.1), "352.1");
  EXPECT_EQ(readableSetting(4e-5), "4×10⁻⁵");
  EXPECT_EQ(readableSetting(0.25), "0.25");
}

TEST(Numbers, IndicesInARow_AreGivenByTheirEnds) {
  EXPECT_EQ(indicesText({}), "");
  EXPECT_EQ(indicesText({3}), "3");
  EXPECT_EQ(indicesText({0, 1, 4}), "0, 1, 4");
  EXPECT_EQ(indicesText({0, 2, 3, 4, 5, 7}), "0, 2 to 5, 7");
}

TEST(Numbers, Durations_AreInSecondsMinutesHours) {
  EXPECT_EQ(readableDuration(12.34), "12.3 s");
  EXPECT_EQ(readableDuration(59.99), "1 min 00 s");
  EXPECT_EQ(readableDuration(754.2), "12 min 34 s");
  EXPECT_EQ(readableDuration(3720.0), "1 h 02 min");
}

TEST(Base64, Rfc4648_Examples) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Labels, Fields_AreTypesetAndEscaped) {
  EXPECT_EQ(fieldLabel("stress_rp"), "shear stress σ_rφ");
  EXPECT_EQ(fieldLabel("my_<field>"), "my <field>");
  EXPECT_EQ(mathHtml("σ_rφ ∝ r^p & x _y"), "σ<sub>rφ</sub> ∝ r<sup>p</sup> &amp; x _y");
  EXPECT_EQ(mathHtml("spring_dashpot-cut, b2_version, Ψ_i, 2R_i, ΩR_i"),
            "spring_dashpot-cut, b2_version, Ψ<sub>i</sub>, 2R<sub>i</sub>, ΩR<sub>i</sub>");
  EXPECT_EQ(mathHtml("k_n, t_c/50 (Ψ_f) of my_engine_n & <i>"),
            "k<sub>n</sub>, t<sub>c</sub>/50 (Ψ<sub>f</sub>) of my_engine_n &amp; &lt;i&gt;");
  EXPECT_EQ(mathHtml("σ_φr·2πr²h"), "σ<sub>φr</sub>·2πr²h");
}

}  // namespace
}  // namespace crossgrain::reports
