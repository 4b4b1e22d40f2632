#include "sinew/backend/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refusal.h"
#include "sinew/base/error.h"

namespace sinew::backend {
namespace {

std::string filled(std::string_view text, const Fields& fields) {
  return fill_template("a template", text, fields);
}

TEST(Render, PutsTextsInAsTheyAre) {
  Fields fields;
  fields.text("name", "<a> & \"b\"");
  EXPECT_EQ(filled("f({{name}}, {{{name}}}){{! not this }};", fields),
            "f(<a> & \"b\", <a> & \"b\");");
}

TEST(Render, RefusesNamesThatNothingFillsIn) {
  Fields inner, fields;
  inner.text("inner", "x");
  fields.text("name", "y");
  fields.list("list", {inner});
  fields.section("absent", false);
  const struct {
    const char* text;
    const char* error;
  } cases[] = {
      {"a\n  {{unknown}}", "a template:2: nothing fills in 'unknown'; correct the name"},
      {"{{name}} {{{unknown}}}", "a template:1: nothing fills in 'unknown'"},
      {"{{#list}}{{inner}}{{/list}}{{inner}}", "a template:1: nothing fills in 'inner'"},
      {"{{#list}}\n{{unknown}}{{/list}}", "a template:2: nothing fills in 'unknown'"},
      {"{{^absent}}{{absent}}{{/absent}}", "a template:1: 'absent' is a section, and has no text"},
      // Of Mustache, but not of what is known here; names have no blanks around them.
      {"{{&name}}", "nothing fills in '&name'"},
      {"{{>name}}", "nothing fills in '>name'"},
      {"{{ name }}", "nothing fills in ' name '"},
      {"{{}}", "nothing fills in ''"},
      {"{{list}}", "a template:1: 'list' is a section, and has no text; write {{#list}}"},
  };
  for (const auto& [text, error] : cases) {
    EXPECT_THAT(refusal([&] { filled(text, fields); }), testing::HasSubstr(error)) << text;
  }
}

TEST(Render, AsksInSectionsWhetherANameIsThere) {
  Fields fields;
  fields.section("unit", false);
  const std::string text = "joint{{#unit}} [{{unit}}]{{/unit}}{{^unit}}, no unit{{/unit}}";
  EXPECT_EQ(filled(text, fields), "joint, no unit");
  fields.text("unit", "rad");
  EXPECT_EQ(filled(text, fields), "joint [rad]");
}

TEST(Render, NamesTheFileOfATemplate) {
  EXPECT_THAT(refusal([] { render("c/readable.c.mustache", {}); }),
              testing::HasSubstr("templates/c/readable.c.mustache:2: nothing fills in 'banner'"));
}

TEST(Render, LeavesOutSectionsThatAreNotThere) {
  Fields fields;
  fields.section("there", true);
  fields.section("missing", false);
  fields.list("empty", {});
  EXPECT_EQ(filled("{{#there}}1{{/there}}{{^there}}2{{/there}}", fields), "1");
  EXPECT_EQ(filled("{{#missing}}1{{/missing}}{{^missing}}2{{/missing}}", fields), "2");
  EXPECT_EQ(filled("{{#empty}}1{{/empty}}{{^empty}}2{{/empty}}", fields), "2");
  EXPECT_EQ(filled("{{#missing}}1{{#there}}2{{/there}}{{/missing}}3", fields), "3");
}

TEST(Render, RefusesSectionsThatNothingNames) {
  Fields first, second, fields;
  first.text("name", "a");
  second.section("last", true);
  fields.list("items", {first, second});
  fields.section("missing", false);
  const auto refused = [&](const char* text) { return refusal([&] { filled(text, fields); }); };
  EXPECT_THAT(refused("a\n{{#itmes}}{{name}}{{/itmes}}"),
              testing::HasSubstr("a template:2: nothing names the section 'itmes'; correct"));
  EXPECT_THAT(refused("{{^mising}}1{{/mising}}"), testing::HasSubstr("the section 'mising'"));
  EXPECT_THAT(refused("{{#items}}{{#lats}}{{/lats}}{{/items}}"),
              testing::HasSubstr("the section 'lats'"));
  EXPECT_THAT(refused("{{# missing}}{{/ missing}}"), testing::HasSubstr("the section ' missing'"));
  EXPECT_EQ(filled("{{#items}}{{^last}},{{/last}}{{/items}}", fields), ",")
      << "another item of the list names it";
}

TEST(Render, RepeatsAListAndSeesWhatIsAroundIt) {
  Fields one, two, fields;
  one.text("name", "one");
  two.text("name", "two");
  two.section("last", true);
  fields.text("type", "double");
  fields.list("items", {one, two});
  EXPECT_EQ(filled("{{#items}}{{type}} {{name}}{{^last}}, {{/last}}{{/items}}", fields),
            "double one, double two");
}

TEST(Render, LeavesOutLinesThatHoldNothingButSections) {
  Fields item, fields;
  item.text("name", "x");
  fields.list("items", {item, item});
  EXPECT_EQ(filled("a\n  {{#items}}\n  {{name}}\n  {{/items}}\nb\n\nc", fields),
            "a\n  x\n  x\nb\n\nc");
}

TEST(Render, RefusesMalformedTemplates) {
  Fields fields;
  fields.section("a", true);
  fields.section("b", false);
  for (const char* text : {"{{a", "{{{a}}", "{{#a}}", "{{#b}}", "{{/a}}", "{{#a}}{{/b}}",
                           "{{#a}}{{#b}}{{/a}}{{/b}}", "{{^a}}{{#b}}{{/a}}"})
    EXPECT_THROW(filled(text, fields), Error) << text;
}

TEST(Render, RefusesSectionsThatStandTooDeepInEachOther) {
  Fields fields;
  fields.section("a", true);
  const auto nested = [](int depth) {
    std::string text = "x";
    for (int k = 0; k < depth; ++k) text = "{{#a}}" + text + "{{/a}}";
    return text;
  };
  EXPECT_EQ(filled(nested(64), fields), "x");
  EXPECT_THROW(filled(nested(65), fields), Error);
}

}  // namespace
}  // namespace sinew::backend
