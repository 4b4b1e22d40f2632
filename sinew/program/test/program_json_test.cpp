#include "sinew/program/program_json.h"

#include <gtest/gtest.h>

#include "refusal.h"
#include "sinew/base/error.h"

namespace sinew::program {
namespace {

constexpr const char* kText = R"({
 "sinew-program": 1,
 "name": "sum",
 "iri": "https://example.org/sum",
 "variables": [
  {"name": "a", "iri": "i:a", "represents": "i:link", "quantity": "wrench", "unit": "N-M N",
   "frame": "i:frame", "role": "input", "output": false, "size": 6},
  {"name": "b", "iri": "i:b", "represents": "", "quantity": "wrench", "unit": "N-M N", "frame": "",
   "role": "constant", "output": false, "size": 6, "value": [0.1, -2, 1e-300, 3.5, 0, 5]},
  {"name": "c", "iri": "i:c", "represents": "", "quantity": "wrench", "unit": "N-M N", "frame": "",
   "role": "internal", "output": true, "size": 6}],
 "closures": [{"operation": "accumulate-wrench", "iri": "i:sum", "step": "i:step", "about": "i:link",
               "arguments": ["a", "b", "c"]}],
 "schedule": [0]
})";

// The text with one part replaced.
std::string with(const std::string& from, const std::string& to) {
  std::string text = kText;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string fault_of(const std::string& text) {
  return refusal([&] { from_json(text, "sum.json"); });
}

TEST(ProgramJson, IsReadAndWrittenWithoutLoss) {
  const Program program = from_json(kText, "sum.json");
  ASSERT_EQ(program.variables.size(), 3U);
  EXPECT_EQ(program.variables[1].value, (std::vector<double>{0.1, -2, 1e-300, 3.5, 0, 5}));
  EXPECT_EQ(program.variables[0].frame, "i:frame");
  EXPECT_EQ(program.closures[0].arguments, (std::vector<std::uint32_t>{0, 1, 2}));
  const std::string text = to_json(program);
  EXPECT_EQ(to_json(from_json(text, "again.json")), text);
}

struct JsonFault {
  const char* name;
  std::string text;
  const char* says;
};

class ProgramJsonFaults : public testing::TestWithParam<JsonFault> {};

TEST_P(ProgramJsonFaults, AreErrorsWithFileAndRemedy) {
  const std::string fault = fault_of(GetParam().text);
  EXPECT_EQ(fault.substr(0, 8), "sum.json") << fault;
  EXPECT_NE(fault.find(GetParam().says), std::string::npos) << fault;
}

INSTANTIATE_TEST_SUITE_P(
    All, ProgramJsonFaults,
    testing::Values(
        JsonFault{"not_json", "{\n\"sinew-program\": 1,\n oops}", "sum.json:3"},
        JsonFault{"empty", "", "not JSON"}, JsonFault{"a_list", "[]", "is not an object"},
        JsonFault{"other_version", with("\"sinew-program\": 1", "\"sinew-program\": 2"),
                  "this Sinew reads version 1"},
        JsonFault{"missing_field", with("\"name\": \"sum\",", ""), "has no 'name'"},
        JsonFault{"unknown_field", with("\"name\": \"sum\",", "\"name\": \"sum\", \"nmae\": 1,"),
                  "unknown field 'nmae'"},
        JsonFault{"wrong_type", with("\"output\": true", "\"output\": 1"), "not true or false"},
        JsonFault{"wrong_role", with("\"internal\"", "\"inner\""), "roles are input"},
        JsonFault{"negative_size", with("\"size\": 6},", "\"size\": -6},"), "whole number"},
        JsonFault{"huge_size", with("\"size\": 6},", "\"size\": 99999999999},"), "whole number"},
        JsonFault{"value_of_text", with("3.5", "\"3.5\""), "not a number"},
        JsonFault{"unknown_argument", with("[\"a\",", "[\"z\","), "no variable has that name"},
        JsonFault{"dangling_schedule", with("[0]", "[1]"), "there are 1 closures"},
        JsonFault{"too_deep", "[[[[[[[[[[]]]]]]]]]]", "nested too deeply"},
        JsonFault{"not_valid", with("\"size\": 6},", "\"size\": 5},"), "the port takes 6"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(ProgramJson, HasALimitOnItsSize) {
  const std::string text(kMaximumProgramBytes + 1, ' ');
  EXPECT_NE(fault_of(text).find("at most"), std::string::npos);
}

}  // namespace
}  // namespace sinew::program
