// How structs become JSON and come back.
#include "results/schema.hpp"

#include <gtest/gtest.h>

#include "results/head.hpp"
#include "tests/support/refusal.hpp"

namespace crossgrain::inline results {

enum class Colour { red, green };
constexpr auto namesOf(Colour) {
  return std::array<std::string_view, 2>{"red", "green"};
}

struct Leaf {
  double length = 1.0;
  std::optional<double> width;
  std::optional<int> age;
  Colour colour = Colour::red;
};
void fields(auto& io, Leaf& leaf) {
  io("length", leaf.length);
  io("width", leaf.width);
  io.present("age", leaf.age);
  io("colour", leaf.colour);
}

struct Tree {
  std::string name;
  bool old = false;
  std::vector<Leaf> leaves;
  std::map<std::string, double> counters;
  std::array<double, 2> place{};
};
void fields(auto& io, Tree& tree) {
  io("name", tree.name);
  io("old", tree.old);
  io("leaves", tree.leaves);
  io("counters", tree.counters);
  io("place", tree.place);
}

namespace {

Tree oak() {
  return {"oak",
          true,
          {{0.1, 0.2, {}, Colour::green}, {1e-300, {}, 3, Colour::red}},
          {{"n", 2.0}},
          {1.0, -0.0}};
}

TEST(JsonFields, Struct_WrittenAndRead_HasTheSameBits) {
  const Json there = jsonOf(oak());
  EXPECT_EQ(there.dump(),
            R"({"counters":{"n":2.0},"leaves":[{"colour":"green","length":0.1,"width":0.2},)"
            R"({"age":3,"colour":"red","length":1e-300,"width":null}],"name":"oak","old":true,)"
            R"("place":[1.0,-0.0]})");
  const Tree back = readAs<Tree>(Json::parse(there.dump()));
  EXPECT_EQ(jsonOf(back), there);
  EXPECT_EQ(back.leaves[0].colour, Colour::green);
  EXPECT_FALSE(back.leaves[1].width);
}

TEST(JsonFields, MissingMember_IsTheDefault) {
  const Leaf leaf = readAs<Leaf>(Json::object());
  EXPECT_EQ(leaf.length, 1.0);
  EXPECT_FALSE(leaf.width);
}

TEST(JsonFields, InfiniteNumber_ReadsAsNaN) {
  Leaf leaf;
  leaf.length = INFINITY;
  EXPECT_TRUE(std::isnan(readAs<Leaf>(Json::parse(jsonOf(leaf).dump())).length));
}

TEST(JsonFields, WrongTypeOrWord_ThrowsWithItsPath) {
  Json tree = jsonOf(oak());
  tree["leaves"][1]["length"] = "long";
  EXPECT_EQ(test::refusalOf<FieldError>([&] { readAs<Tree>(tree); }),
            "leaves.1.length: is string, not a number");
  tree = jsonOf(oak());
  tree["leaves"][0]["colour"] = "blue";
  EXPECT_THROW(readAs<Tree>(tree), FieldError);
}

TEST(ResultsHead, UnknownBuild_IsLeftOut) {
  ResultsHead head{"s",
                   "compare",
                   "1",
                   "abc",
                   "crossgrain compare",
                   "2026-01-01T00:00:00Z",
                   {"cpu", "os", 2},
                   {"quick", "", "quick.toml", "a = 1"}};
  const Json there = jsonOf(head);
  EXPECT_EQ(there["machine"]["cores"], 2);
  EXPECT_EQ(there["build"], "abc");
  EXPECT_EQ(jsonOf(readAs<ResultsHead>(there)), there);
  head.build.clear();
  EXPECT_FALSE(jsonOf(head).contains("build")) << "of results whose build nobody knows";
}

}  // namespace
}  // namespace crossgrain::inline results
