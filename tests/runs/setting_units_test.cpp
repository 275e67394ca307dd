// What settings are multiplied by where a length is twice as long, a mass three times as large and
// a time five times as long.
#include "runs/stability/setting_units.hpp"

#include <gtest/gtest.h>

namespace {

using namespace crossgrain;

constexpr Units units{.length = 2.0, .mass = 3.0, .time = 5.0};

TEST(SettingUnits, EachUnitByItsLengthsMassesAndTimes) {
  const std::pair<const char*, double> expected[] = {
      {"", 1.0},           {"-", 1.0},           {"rad", 1.0},      {"smallest radius", 1.0},
      {"m", 2.0},          {"kg", 3.0},          {"s", 5.0},        {"m/s", 2.0 / 5},
      {"m/s²", 2.0 / 25},  {"1/s", 1.0 / 5},     {"/s", 1.0 / 5},   {"Hz", 1.0 / 5},
      {"rad/s", 1.0 / 5},  {"N", 3.0 * 2 / 25},  {"N/m", 3.0 / 25}, {"kg/s", 3.0 / 5},
      {"J", 3.0 * 4 / 25}, {"Pa", 3.0 / 2 / 25}, {"1/m", 1.0 / 2},  {"kg/m³", 3.0 / 8}};
  for (const auto& [unit, factor] : expected)
    EXPECT_DOUBLE_EQ(factorOf(unit, units).value_or(0.0), factor) << unit;
  EXPECT_FALSE(factorOf("furlong", units));
}

TEST(SettingUnits, DefaultsAreSaidAndZeroStays) {
  const std::vector<SettingSpec> specs = {{"skin", 0.5, "m", "", {}},
                                          {"none", 0.0, "furlong", "", {}},
                                          {"share", 0.25, "-", "", {}},
                                          {"speed", 1.0, "m/s", "", {}}};
  const Settings expected = {{"skin", 1.0}, {"speed", 10.0 * 2 / 5}};
  EXPECT_EQ(inUnits({{"speed", 10.0}}, specs, units), expected);
  EXPECT_EQ(inUnits({{"speed", 10.0}}, specs, {}), (Settings{{"speed", 10.0}}));
  EXPECT_THROW(inUnits({{"none", 1.0}}, specs, units), UnsupportedScene);
}

}  // namespace
