// What would take all memory, or all time, or is quoted though it is nobody's business.
#include <sys/stat.h>

#include <regex>

#include "bad_cases.hpp"

namespace crossgrain::test {
namespace {

TEST_F(LoaderErrors, NotANumberIsSaidOfEveryNumberOfEverySection) {
  const std::string assembly =
      "[case]\nkind = \"assembly\"\n[law]\nkn = 352.1\ngn = 0.19\ntangential = \"none\"\n"
      "[assembly]\nduration = 0.1\n[[assembly.disks]]\nposition = [0.0, 0.0]\nradius = 0.1\n"
      "mass = 1e-3\n";
  const std::string whole = plus(
      "inertia_factor = 0.5\nmax_overlap = 0.2\n[bottom]\nmu = 2e-5\nkb = 267.1\ngb = 0.15\n"
      "tau_m = 1e-4\ngravity = 9.81\n[preparation]\ndilation = 1.25\nvelocity = 0.05\n"
      "shrink_time = 1.0\nrotations = 2.0\ndt = 1e-5\n[averaging]\nline_width = 0.5\n"
      "settle_rotations = 0.25\nrotations = 1.0\nconfidence = 0.95\n[averaging.margins]\n"
      "spin = { relative = 0.1, why = \"w\" }\n[run]\ntimeout = 120.0\n"
      "steps_per_contact = 50.0\n[cost]\nspeed = 0.01\naverage_steps = [50.0]\n[engines.grain]\n"
      "skin = 0.1\n");
  int tried = 0;
  for (const std::string& text : {whole, soundCollision + "start_phase = 0.5\n", assembly}) {
    const std::regex number("= \\[?([0-9.e-]+[0-9]+|0|1)");
    for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at) {
      if (at->str(1).find_first_of(".e") == std::string::npos) continue;  // whole numbers
      for (const char* const bad : {"nan", "-nan", "inf"}) {
        std::string broken = text;
        broken.replace(static_cast<std::size_t>(at->position(1)),
                       static_cast<std::size_t>(at->length(1)), bad);
        write("case.toml", broken);
        const std::string message = messageOf("case.toml");
        const std::string wanted = bad[0] == 'i' ? "is infinite" : "is not a number";
        EXPECT_NE(message.find(wanted), std::string::npos) << message << "\n" << broken;
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 100);
}

// Of two small disks under the sound case's law, whatever the runs' own step is.
TEST_F(LoaderErrors, StepOfPreparingThatNoContactBears) {
  write("case.toml", plus("[preparation]\ndt = 1e-2\n"));
  const std::string message = messageOf("case.toml");
  EXPECT_TRUE(message.starts_with("case.toml:25:6: preparation.dt = ")) << message;
  EXPECT_NE(message.find("the longest step"), std::string::npos) << message;
}

TEST_F(LoaderErrors, MinusZeroIsZero) {
  write("case.toml", line(5, "gn = -0.0"));
  EXPECT_FALSE(std::signbit(loadCase("case.toml").front().law.gn));
}

TEST_F(LoaderErrors, SeedsThatTheGeneratorWouldCutOff) {
  expectMessages({
      {plus("[preparation]\nseed = 4294967296\n"),
       "case.toml:25:8: preparation.seed = 4294967296: must be in [0, 4294967295]"},
      {plus("[preparation]\nseed = 4294967295\npackings = 2\n"), ""},
  });
  write("case.toml", soundCase);
  const std::string endless = "preparation.seed=99999999999999999999999";
  const std::string message = messageOf("case.toml", {endless});
  EXPECT_TRUE(message.starts_with("--set " + endless)) << message;
  EXPECT_EQ(message.find("string"), std::string::npos) << message;
}

TEST_F(LoaderErrors, MoreDisksThanACaseMayHave) {
  const auto assembly = [](const std::string& disks) {
    return "[case]\nkind = \"assembly\"\n[law]\nkn = 352.1\ngn = 0.19\ntangential = \"none\"\n"
           "[assembly]\nduration = 0.1\n" +
           disks;
  };
  const std::string grid =
      "[[assembly.disks]]\nposition = [0.0, 0.0]\nradius = 0.1\nmass = 1.0\n"
      "grid = { columns = 1000, rows = 600 }\n";
  expectMessages({
      {withLine(line(18, "small = 600000"), 19, "large = 600000"),
       "case.toml:18:9: particles.small = 600000: with large = 600000 that is more than 1000000 "
       "disks"},
      {line(14, "wall_spacing = 1e-7"),
       "case.toml:14:16: cell.wall_spacing = 1e-07: makes 6.6e+06 wall disks: a case may have at "
       "most 1000000"},
      {assembly("[[assembly.disks]]\nposition = [0.0, 0.0]\nradius = 0.1\nmass = 1.0\n"
                "grid = { columns = 100000, rows = 100000 }\n"),
       "case.toml:13:20: assembly.disks[0].grid.columns = 100000: times 100000 rows are 1e+10 "
       "disks: a case may have at most 1000000"},
      {assembly(grid + grid),
       "case.toml:9:1: assembly.disks: these are more than the 1000000 disks that a case may have"},
      {collision(9,
                 "psi = { from = 0.0, to = 4.0, count = 10000 }\ncounter_spin = [0, 1, 2, 3, 4, "
                 "5, 6, 7, 8, 9, 10]"),
       "case.toml:9:7: [collision.psi]: with all vn and counter_spin 110000 collisions: at most "
       "100000"},
      {plus("[averaging]\nsnapshots_per_rotation = 1000000\nrotations = 11\n"),
       "case.toml:26:13: averaging.rotations = 11: with 1000000 snapshots_per_rotation: more than "
       "10000000 snapshots"},
      {line(16, "omega = 1e-12"),
       "case.toml:16:9: cell.omega = 1e-12: preparation, settling and averaging would take "
       "4.69e+17 steps: at most 1e+12"},
  });
}

/// A whole number that no double is is rounded, as a decimal one is.
TEST_F(LoaderErrors, WholeNumbersBeyondTheGapsOfDoublesAreTaken) {
  write("case.toml", soundCase);
  for (const char* number : {"9007199254740993", "9223372036854775807"})
    EXPECT_EQ(loadCase("case.toml", {std::string("looks.budget=") + number}).front().looks.budget,
              std::strtod(number, nullptr));
}

TEST_F(LoaderErrors, ATimeoutIsOneThatAProgramCanAnswerIn) {
  write("case.toml", soundCase);
  for (const char* timeout : {"1e-308", "1e300"}) {
    try {
      loadCase("case.toml", {std::string("run.timeout=") + timeout});
      ADD_FAILURE() << timeout;
    } catch (const BadInput& refused) {
      EXPECT_NE(std::string(refused.what()).find("run.timeout"), std::string::npos);
    }
  }
}

TEST_F(LoaderErrors, BlankSentencesAndEndlessNames) {
  expectMessages({
      {plus("[averaging.margins]\nspin = { relative = 0.1, why = \"  \" }\n"),
       "case.toml:25:32: averaging.margins.spin.why = \"  \": must give the reason"},
      {line(2, "kind = \"couette\"\nname = \"" + std::string(81, 'a') + "\""),
       "case.toml:3:8: case.name = \"" + std::string(81, 'a') +
           "\": must be of letters, digits and . _ - +, at most 80, and not start with a dot"},
      {line(2, "kind = \"couette\"\nextends = \"\""),
       "case.toml:3:11: case.extends: must be the path of a case file"},
  });
}

TEST_F(LoaderErrors, WhatIsNoFileIsSaidAndTheNearestNamed) {
  write("cases/quick.toml", soundCase);
  write("cases/notes.txt", "");
  EXPECT_EQ(messageOf("cases/quik.toml"),
            "cases/quik.toml: no such file (did you mean cases/quick.toml?)");
  EXPECT_EQ(messageOf("cases"), "cases: is a folder, not a file (there are: quick.toml)");
  ASSERT_EQ(::mkfifo("pipe.toml", 0600), 0);
  EXPECT_EQ(messageOf("pipe.toml"), "pipe.toml: is a named pipe, not a file");
  EXPECT_EQ(messageOf("/dev/null"), "/dev/null: is a device, not a file");
  write("top.toml", "[case]\nextends = \"cases/quik.toml\"\n");
  EXPECT_EQ(messageOf("top.toml"),
            "top.toml:2:11: case.extends = \"cases/quik.toml\": no such file (looked for "
            "cases/quik.toml) (did you mean cases/quick.toml?)");
}

TEST_F(LoaderErrors, AnUnreadableFileIsNotSuggestedForItself) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads everything";
  write("cases/quick.toml", soundCase);
  ASSERT_EQ(::chmod("cases/quick.toml", 0), 0);
  EXPECT_EQ(messageOf("cases/quick.toml").find("did you mean"), std::string::npos);
}

/// A copy of a shipped case names what it extends by its place among the program's own cases.
TEST_F(LoaderErrors, ACopyElsewhereMayExtendAShippedCase) {
  write("mine.toml", "[case]\nextends = \"nu-0.804.toml\"\n");
  EXPECT_EQ(messageOf("mine.toml"),
            "mine.toml:2:11: case.extends = \"nu-0.804.toml\": no such file (looked for "
            "nu-0.804.toml) (did you mean cases/couette/nu-0.804.toml?)");
  write("mine.toml", "[case]\nextends = \"../laws/thesis.toml\"\n");
  EXPECT_TRUE(messageOf("mine.toml").ends_with("(did you mean cases/laws/thesis.toml?)"));
  write("mine.toml", "[case]\nextends = \"cases/couette/nu-0.804.toml\"\n[law]\nmu = 0.3\n");
  EXPECT_EQ(messageOf("mine.toml"), "");
  EXPECT_EQ(loadCase("mine.toml").front().law.mu, 0.3);
  // What lies beside the file goes before it.
  write("cases/couette/nu-0.804.toml", soundCase);
  EXPECT_EQ(loadCase("mine.toml").front().particles.small, 210);
}

TEST_F(LoaderErrors, NothingOfAFileOutsideTheCasesFolderIsQuoted) {
  const std::string secret = "hunter2-s3cr3t";
  write("mine/top.toml", "[case]\nextends = \"../theirs/it.toml\"\n");
  for (const auto& [text, where] : std::vector<std::pair<std::string, std::string>>{
           {secret + "\n", "mine/../theirs/it.toml:1:"},
           {"password = \"" + secret, "mine/../theirs/it.toml:1:"},
           {secret + " = 1\n", "mine/../theirs/it.toml:1:1: a key that no case has"},
           {"[case]\nkind = \"couette\"\n" + secret + " = 1\n", "theirs/it.toml:3:1: "},
           {"[case]\nkind = \"" + secret + "\"\n", "theirs/it.toml:2:8: case.kind: unknown name"},
           {"[case]\nextends = \"" + secret + "\"\n", "theirs/it.toml:2:11: case.extends: no such"},
           {"[case]\nname = \"" + secret + " x\"\nkind = \"couette\"\n", ""},
           {withLine(soundCase, 4, "kn = \"" + secret + "\""), "theirs/it.toml:4:6: law.kn: must"},
           {soundCase + "[[variants]]\nname = \"" + secret + "/\"\n", "theirs/it.toml:25:8: "}}) {
    write("theirs/it.toml", text);
    const std::string message = messageOf("mine/top.toml");
    EXPECT_EQ(message.find(secret), std::string::npos) << message;
    EXPECT_NE(message.find(where.substr(
                  where.rfind("theirs") == std::string::npos ? 0 : where.rfind("theirs"))),
              std::string::npos)
        << message << " | " << where;
    EXPECT_EQ(message.empty(), false);
  }
  // In the case's own folder it helps to be told.
  write("mine/law.toml", "[case]\nkind = \"cuette\"\n");
  write("mine/top.toml", "[case]\nextends = \"law.toml\"\n");
  EXPECT_EQ(messageOf("mine/top.toml"),
            "mine/law.toml:2:8: case.kind = \"cuette\": unknown name (did you mean couette?)");
}

}  // namespace
}  // namespace crossgrain::test
