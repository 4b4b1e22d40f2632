#include "sinew/data/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sinew/base/error.h"
#include "sinew/data/embedded.h"

namespace sinew::data {
namespace {

double converted(double value, const char* from, const char* to) {
  const auto a = find_unit(from), b = find_unit(to);
  if (!a || !b) return std::nan("");
  const auto way = conversion(*a, *b);
  return way ? way->scale * value + way->offset : std::nan("");
}

TEST(Units, AreFoundByQudtNameSymbolAndProduct) {
  for (const char* name :
       {"M",   "MilliM", "mm",         "KiloGM", "kg",        "SEC",        "DEG",     "rad/s",
        "N-M", "N*m",    "M-PER-SEC2", "m/s^2",  "KiloGM-M2", "kg*m^2/s^2", "PER-SEC", "unitless",
        "1/s", "N·m",    "DEG_C",      "rpm",    "M2",        "KiloN-M",    "s^-1"}) {
    EXPECT_TRUE(find_unit(name)) << name;
  }
}

TEST(Units, OfTheSameThingHaveTheSameSize) {
  const std::pair<const char*, const char*> equal[] = {
      {"M-PER-SEC2", "m/s^2"},  {"N-M", "J"},      {"KiloGM-M2-PER-SEC2", "N*m"},
      {"KiloM-PER-HR", "km/h"}, {"PER-SEC", "Hz"}, {"REV-PER-MIN", "rpm"}};
  for (const auto& [a, b] : equal) {
    EXPECT_EQ(find_unit(a)->dimension, find_unit(b)->dimension) << a << " " << b;
    EXPECT_DOUBLE_EQ(find_unit(a)->scale, find_unit(b)->scale) << a << " " << b;
  }
}

TEST(Units, ConvertByScaleAndOffset) {
  EXPECT_EQ(converted(1.5, "m", "mm"), 1500);
  EXPECT_EQ(converted(1500, "MilliM", "M"), 1.5);
  EXPECT_DOUBLE_EQ(converted(180, "deg", "rad"), M_PI);
  EXPECT_DOUBLE_EQ(converted(20, "DEG_C", "K"), 293.15);
  EXPECT_NEAR(converted(300, "K", "degC"), 26.85, 1e-12);
  EXPECT_NEAR(converted(212, "degF", "degC"), 100, 1e-12);
  EXPECT_DOUBLE_EQ(converted(36, "km/h", "m/s"), 10);
  EXPECT_DOUBLE_EQ(converted(1, "rev/min", "rad/s"), 2 * M_PI / 60);
  EXPECT_DOUBLE_EQ(converted(2, "KiloN-M", "N-M"), 2000);
}

TEST(Units, OfDifferentDimensionsDoNotConvert) {
  EXPECT_FALSE(conversion(*find_unit("m"), *find_unit("rad")));
  EXPECT_FALSE(conversion(*find_unit("Hz"), *find_unit("rad/s")));  // 2 pi lies between them
  EXPECT_FALSE(conversion(*find_unit("unitless"), *find_unit("deg")));
}

TEST(Units, WithAnOffsetStandAlone) {
  EXPECT_FALSE(find_unit("degC/s"));
  EXPECT_FALSE(find_unit("DEG_C-PER-SEC"));
  EXPECT_TRUE(find_unit("K/s"));
}

TEST(Units, ThatDoNotExistAreRefusedWithASuggestion) {
  UnitProblem problem;
  EXPECT_FALSE(UnitTable::shipped().find("metr", &problem));
  EXPECT_FALSE(UnitTable::shipped().find("UNITLES", &problem));
  EXPECT_EQ(problem.remedy, "did you mean UNITLESS or unitless?");
  for (const char* text : {"", "m^99", "m//s", "/s", "m^", "PER-PER-SEC", "-", "M-PER-", "m^-"}) {
    EXPECT_FALSE(find_unit(text)) << text;
  }
}

TEST(Units, ThatAreMisspeltAreSuggestedAsTheirPlaceSpellsThem) {
  const struct {
    const char *text, *either, *qudt;
  } cases[] = {
      {"Kg", "kg", "KiloGM"},
      {"KG", "kg", "KiloGM"},
      {"kilogramm", "", ""},
      {"Nm", "N*m or nm", "N-M or NanoM"},
      {"MM", "Mm or mm", "MegaM or MilliM"},
      {"Deg", "deg or DEG", "DEG"},
      {"degree", "deg", "DEG"},
      {"Rad", "rad or RAD", "RAD"},
      {"M/S", "m/s", "M-PER-SEC"},
      {"Rad/s", "rad/s", "RAD-PER-SEC"},
      {"rad/sec", "rad/s", "RAD-PER-SEC"},
      {"m/s2", "m/s^2", "M-PER-SEC2"},
      {"kgm2", "kg*m^2", "KiloGM-M2"},
      {"meter", "m", "M"},
      {"RAD-PER-SECC", "RAD-PER-SEC or RAD-PER-SEC2", ""},
      {"N*m*sec/radd", "N*m*s/rad", ""},
      {"KiloGm-M2", "KiloGM-M2", "KiloGM-M2"},
      {"xyzzy", "", ""},
  };
  const auto remedy = [](const char* text, UnitSpelling spelling) {
    UnitProblem problem;
    EXPECT_FALSE(UnitTable::shipped().find(text, &problem, spelling)) << text;
    return problem.remedy;
  };
  for (const auto& [text, either, qudt] : cases) {
    const auto suggests = [&](const std::string& expected, UnitSpelling spelling) {
      if (expected.empty()) return;
      EXPECT_EQ(remedy(text, spelling), "did you mean " + expected + "?") << text;
    };
    suggests(either, UnitSpelling::kEither);
    suggests(qudt, UnitSpelling::kQudt);
  }
  EXPECT_EQ(remedy("xyzzy", UnitSpelling::kQudt), "use a QUDT name (MilliM, M-PER-SEC)");
}

// Who writes M/S means metres a second, and not metres a siemens.
TEST(Units, AreNotNamesAndSymbolsInOneProduct) {
  for (const char* text : {"M/S", "m/SEC", "KiloGM*m"}) EXPECT_FALSE(find_unit(text)) << text;
  EXPECT_TRUE(find_unit("m/S"));
}

// What is suggested is a unit, and the same in both spellings.
TEST(Units, ThatAreSuggestedExist) {
  const auto json = nlohmann::json::parse(embedded_file("units.json"));
  for (const auto& usual : json.at("usual")) {
    const auto symbols = find_unit(usual.at("symbols").get<std::string>());
    const auto name = find_unit(usual.at("name").get<std::string>());
    ASSERT_TRUE(symbols && name) << usual;
    EXPECT_EQ(symbols->dimension, name->dimension) << usual;
    EXPECT_NEAR(symbols->scale / name->scale, 1, 1e-15) << usual;
  }
  for (const auto& synonym : json.at("synonyms")) {
    EXPECT_FALSE(find_unit(synonym.at("text").get<std::string>())) << synonym;
    EXPECT_TRUE(find_unit(synonym.at("means").get<std::string>())) << synonym;
  }
}

// As a number of eight bits, metres to the 264th would be a length of 8 of them.
TEST(Units, OfTooLargeExponentsAreRefused) {
  const auto product = [](const std::string& factor, int times) {
    std::string text = factor;
    for (int k = 1; k < times; ++k) text += (factor[0] == 'm' ? "*" : "-") + factor;
    return text;
  };
  EXPECT_EQ(to_string(find_unit(product("m^12", 2))->dimension), "length^24");
  EXPECT_EQ(to_string(find_unit(product("M12", 2))->dimension), "length^24");
  for (const int times : {3, 11, 22, 30}) {
    EXPECT_FALSE(find_unit(product("m^12", times))) << times;
    EXPECT_FALSE(find_unit(product("M12", times))) << times;
    EXPECT_FALSE(find_unit(product("m^-12", times))) << times;
  }
  EXPECT_TRUE(parse_dimension("length^12 length^12"));
  for (const char* text : {"length^25", "length^-25", "length^12 length^13", "length^300"})
    EXPECT_FALSE(parse_dimension(text)) << text;
}

TEST(Units, ComeFromATableThatIsChecked) {
  EXPECT_THROW(UnitTable::read("{", "x.json"), Error);
  EXPECT_THROW(UnitTable::read(R"({"prefixes": [], "units": [{"name": "M"}]})", "x.json"), Error);
  EXPECT_THROW(UnitTable::read(R"({"prefixes": [], "units": [{"name": "M", "symbols": [],
      "dimension": "lenth", "scale": 1}]})",
                               "x.json"),
               Error);
}

TEST(Dimensions, FormAnAlgebra) {
  const Dimension newton = find_unit("N")->dimension, metre = find_unit("m")->dimension;
  EXPECT_EQ(to_string(newton * metre), "length^2 mass time^-2");
  EXPECT_EQ(to_string(newton / newton), "dimensionless");
  EXPECT_EQ(power(metre, 3), find_unit("L")->dimension);
  EXPECT_EQ(parse_dimension(to_string(newton)), newton);
}

TEST(Units, EveryDimensionHasACoherentUnitThatIsFoundAgain) {
  for (const std::string_view name :
       {"UNITLESS", "M", "M-PER-SEC", "RAD-PER-SEC2", "N", "N-M", "N-PER-M", "N-M-SEC-PER-RAD",
        "PER-SEC", "RAD-SEC", "KiloGM-M"})
    EXPECT_EQ(coherent_unit(find_unit(name)->dimension), name);
  for (const std::string_view name : {"V", "J", "KiloGM-PER-M3", "MilliM", "N-PER-M2"}) {
    const std::string coherent = coherent_unit(find_unit(name)->dimension);
    ASSERT_TRUE(find_unit(coherent)) << coherent;
    EXPECT_EQ(find_unit(coherent)->dimension, find_unit(name)->dimension) << coherent;
    EXPECT_EQ(find_unit(coherent)->scale, 1) << coherent;
  }
}

}  // namespace
}  // namespace sinew::data
