// Fills the templates of `templates/`, which hold no logic: names, sections and lists only.
// Everything that depends on the program is decided here, in C++; how the result looks is decided
// there.
//
// They are Mustache (https://mustache.github.io/mustache.5.html), of which these are known:
// {{name}} and {{{name}}} alike, since nothing is escaped; {{#name}} and {{^name}} to {{/name}};
// {{! comment}}. A line that held the ends of sections and is blank when they are filled in is left
// out. A name in braces that nothing fills in is an error, not a blank; and so is a section whose
// name no field has. Where a field has it, if only of another item of a list, the section asks
// whether it is there.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sinew::backend {

struct Fields;
using FieldList = std::vector<Fields>;

// What a template's {{name}} stands for: a text, a section that is there or not, or a repeated
// section.
struct Fields {
  using Value = std::variant<std::string, bool, FieldList>;
  std::map<std::string, Value, std::less<>> values;

  void text(const std::string& name, std::string value) { values[name] = std::move(value); }
  void number(const std::string& name, std::size_t value) { values[name] = std::to_string(value); }
  void section(const std::string& name, bool present) { values[name] = present; }
  void list(const std::string& name, FieldList items) { values[name] = std::move(items); }
};

// The text of a template, for example "c/flat.c.mustache". Throws Error if there is none.
std::string_view template_text(std::string_view path);

// Throws Error, with the line of the template, if it is malformed, has a name that `fields` do not
// fill in, a section that they do not name, or a section's name in the place of a text.
std::string render(std::string_view path, const Fields& fields);

// The same for a text; `path` names it in errors.
std::string fill_template(std::string_view path, std::string_view text, const Fields& fields);

}  // namespace sinew::backend
