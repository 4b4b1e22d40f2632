#include "sinew/backend/render.h"

#include <gtest/gtest.h>

#include "sinew/base/error.h"

namespace sinew::backend {
namespace {

std::string filled(std::string_view text, const Fields& fields) {
  return fill_template("a template", text, fields);
}

TEST(Render, PutsTextsInAsTheyAre) {
  Fields fields;
  fields.text("name", "<a> & \"b\"");
  EXPECT_EQ(filled("f({{name}}, {{{name}}}, {{unknown}}){{! not this }};", fields),
            "f(<a> & \"b\", <a> & \"b\", );");
}

TEST(Render, LeavesOutSectionsThatAreNotThere) {
  Fields fields;
  fields.section("there", true);
  fields.section("missing", false);
  fields.list("empty", {});
  EXPECT_EQ(filled("{{#there}}1{{/there}}{{^there}}2{{/there}}", fields), "1");
  EXPECT_EQ(filled("{{#missing}}1{{/missing}}{{^missing}}2{{/missing}}", fields), "2");
  EXPECT_EQ(filled("{{#empty}}1{{/empty}}{{^empty}}2{{/empty}}", fields), "2");
  EXPECT_EQ(filled("{{#unknown}}1{{#there}}2{{/there}}{{/unknown}}3", fields), "3");
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
