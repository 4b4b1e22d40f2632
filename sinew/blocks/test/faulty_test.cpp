// Faulty files: each is refused with a place, with what is wrong and with what would be right.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "sinew/blocks/elaborate.h"

namespace sinew::blocks {
namespace {

struct Case {
  std::string name, text, message;
};

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
  for (std::size_t at; (at = text.find(mark)) != std::string::npos;)
    text.replace(at, mark.size(), by);
  return text;
}

std::string pose() {
  std::string map, units;
  for (int i = 0; i < 16; ++i) {
    const std::string element = "{" + std::to_string(i / 4) + "," + std::to_string(i % 4) + "}";
    map += std::to_string(i) + " = " + element + " ";
    units += (i % 4 == 3 && i != 15 ? "m = " : "unitless = ") + element + " ";
  }
  return "dproto pose :: geometry { semantic = Pose coord = homogeneous_transformation algebraic = "
         "ht_matrix\n"
         "ddr = :: c99 { double[16] } dr = { " +
         map + "} units = :: qudt, ht_matrix { " + units + "} }";
}

std::vector<Case> cases() {
  std::ifstream file(SINEW_SOURCE_DIR "/sinew/blocks/test/faulty/cases.txt");
  std::vector<Case> all;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("=== ")) {
      all.push_back({line.substr(4), {}, {}});
    } else if (line.starts_with("--- ")) {
      all.back().message = line.substr(4);
    } else if (!all.empty()) {
      all.back().text += line + "\n";
    }
  }
  for (Case& it : all) {
    it.text = replaced(it.text, "%POSE%", pose());
    it.text = replaced(it.text, "%THERMAL%",
                       "domain d :: { semantic : A; coord, dr; coordinates one of A { x = m } "
                       "coordinates two of A { y = m }");
    it.text = replaced(
        it.text, "%USE%",
        "dproto p :: d { semantic = A coord = one algebraic = :: Scalar{x} ddr = :: c99 { double "
        "}\n"
        "dr = { value = x } units = :: qudt, length { m = x } }\nalgebraic length :: Scalar{x}");
  }
  return all;
}

TEST(Faulty, FilesAreAtLeastSixty) { EXPECT_GE(cases().size(), 60u); }

TEST(Faulty, FilesAreRefusedWithTheExpectedMessage) {
  for (const Case& it : cases()) {
    try {
      load_library(it.text, "faulty.blocks");
      ADD_FAILURE() << it.name << ": taken without a word";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(it.message), std::string::npos) << it.name << ":\n"
                                                                               << error.what();
      for (const Problem& problem : error.problems()) {
        EXPECT_GT(problem.place.line, 0u) << it.name << ": no place: " << to_string(problem);
      }
    }
  }
}

TEST(Faulty, AllFaultsOfAFileAreTold) {
  try {
    load_library(
        "algebraic a :: Vectr{3}\n"
        "dproto p :: geometry { semantik = Position }\n"
        "algebraic b :: Vector{2}\n"
        "units u :: qudt, b { m = 0 }\n"
        "nothing\n",
        "faulty.blocks");
    FAIL();
  } catch (const Error& error) {
    ASSERT_EQ(error.problems().size(), 3u) << error.what();
    EXPECT_EQ(error.problems()[0].place.line, 1u);
    EXPECT_EQ(error.problems()[1].place.line, 2u);
    EXPECT_EQ(error.problems()[2].place.line, 5u);
  }
}

TEST(Faulty, NestingHasALimit) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "module m { ";
  EXPECT_THROW(load_library(text, "faulty.blocks"), Error);
  EXPECT_THROW(load_library("ddr d :: c99 " + std::string(100, '{'), "faulty.blocks"), Error);
  std::string formula = "y = ";
  for (int i = 0; i < 1000; ++i) formula += "(";
  EXPECT_THROW(
      load_library(
          "domain d :: { semantic : A coordinates c of A { x = m } coordinates e of A { y = m }\n"
          "formula c -> e of A { " +
              formula +
              " } }\n"
              "algebraic f :: Scalar{x}\n"
              "dproto p :: d { semantic = A coord = c algebraic = f ddr = :: c99 { double }\n"
              "dr = { value = x } units = :: qudt, f { m = x } }",
          "faulty.blocks"),
      Error);
}

}  // namespace
}  // namespace sinew::blocks
