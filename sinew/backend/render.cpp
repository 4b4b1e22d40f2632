#include "sinew/backend/render.h"

#include <kainjow/mustache.hpp>
#include <span>
#include <utility>

#include "sinew/base/error.h"

namespace sinew::backend {

std::span<const std::pair<std::string_view, std::string_view>> embedded_templates();

namespace {

using kainjow::mustache::data;
using kainjow::mustache::mustache;

data to_data(const Fields& fields) {
  data result{data::type::object};
  for (const auto& [name, value] : fields.values) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      result.set(name, *text);
    } else if (const auto* present = std::get_if<bool>(&value)) {
      result.set(name, data{*present ? data::type::bool_true : data::type::bool_false});
    } else {
      data list{data::type::list};
      for (const Fields& item : std::get<FieldList>(value)) list.push_back(to_data(item));
      result.set(name, list);
    }
  }
  return result;
}

}  // namespace

std::string_view template_text(std::string_view path) {
  for (const auto& [name, text] : embedded_templates()) {
    if (name == path) return text;
  }
  throw Error(Problem{{std::string(path), 0, 0},
                      {},
                      "no such template",
                      "templates are embedded when Sinew is built",
                      Severity::kError,
                      {}});
}

std::string render(std::string_view path, const Fields& fields) {
  mustache parsed{std::string(template_text(path))};
  parsed.set_custom_escape([](const std::string& text) { return text; });
  std::string result = parsed.render(to_data(fields));
  if (!parsed.is_valid()) {
    throw Error(Problem{{std::string(path), 0, 0},
                        {},
                        "malformed template: " + parsed.error_message(),
                        "correct the template",
                        Severity::kError,
                        {}});
  }
  // The line of the comment that every template begins with.
  if (!result.empty() && result.front() == '\n') result.erase(0, 1);
  return result;
}

}  // namespace sinew::backend
