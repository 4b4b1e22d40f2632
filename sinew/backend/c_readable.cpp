// The readable style: what a person would write by hand with the support library.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/backend/c_parts.h"
#include "sinew/backend/numbers.h"
#include "sinew/program/kernels.h"

namespace sinew::backend {
namespace {

// The last segment of an IRI.
std::string short_name(const std::string& iri) {
  const std::size_t at = iri.find_last_of("/#");
  return at == std::string::npos ? iri : iri.substr(at + 1);
}

std::string describe(const program::Variable& v) {
  std::string text = v.quantity;
  if (!v.represents.empty()) text += " of " + short_name(v.represents);
  if (!v.frame.empty()) text += ", seen from " + short_name(v.frame);
  if (!v.unit.empty()) text += " [" + v.unit + "]";
  return c_comment(text);
}

}  // namespace

RenderedSource readable_source(const program::Program& program, const program::Interface& interface,
                               const std::vector<std::string>& identifiers, const Fields& common) {
  const auto item = [&](std::uint32_t variable) {
    const program::Variable& v = program.variables[variable];
    Fields fields;
    fields.text("identifier", identifiers[variable]);
    fields.number("size", v.size);
    fields.text("comment", describe(v));
    return fields;
  };
  // An input that nothing reads gets no name.
  std::vector<bool> named(program.variables.size(), false);
  for (std::size_t i = 0; i < named.size(); ++i) named[i] = program.variables[i].output;
  for (const program::Closure& closure : program.closures) {
    for (const std::uint32_t argument : closure.arguments) named[argument] = true;
  }
  const auto slot_items = [&](const std::vector<program::Slot>& slots) {
    FieldList list;
    for (const program::Slot& slot : slots) {
      if (!named[slot.variable]) continue;
      Fields fields = item(slot.variable);
      fields.number("offset", slot.offset);
      list.push_back(std::move(fields));
    }
    return list;
  };

  FieldList constants;
  FieldList internals;
  for (std::uint32_t i = 0; i < program.variables.size(); ++i) {
    const program::Variable& v = program.variables[i];
    if (v.role == program::Role::kInternal) internals.push_back(item(i));
    if (v.role != program::Role::kConstant) continue;
    Fields fields = item(i);
    std::string values;
    for (const double value : v.value) values += (values.empty() ? "" : ", ") + c_number(value);
    fields.text("values", values);
    constants.push_back(std::move(fields));
  }

  CodeBlock body;
  std::string heading;
  for (const std::uint32_t index : program.schedule) {
    const program::Closure& closure = program.closures[index];
    std::string next = c_comment(short_name(closure.step) + ": " + short_name(closure.about));
    if (next != heading) {
      if (!heading.empty()) body.add("");
      body.add("  /* " + next + " */");
      heading = std::move(next);
    }
    std::string call = "  " + program::support_function(closure.operation) + "(";
    const std::size_t count = closure.arguments.size();
    // An operator of many arguments takes them as an array of pointers and their number.
    const bool many = program::find_kernel(closure.operation)->many();
    if (many) call += "(const double *const[]){";
    for (std::size_t i = 0; i < count; ++i) {
      const bool last_of_many = many && i + 1 == count;
      call += (i == 0         ? ""
               : last_of_many ? fmt::format("}}, {}, ", count - 1)
                              : ", ") +
              identifiers[closure.arguments[i]];
    }
    body.add(call + ");", index);
  }

  const auto reads_none = [&](const std::vector<program::Slot>& slots) {
    return std::none_of(slots.begin(), slots.end(),
                        [&](const program::Slot& slot) { return named[slot.variable]; });
  };
  Fields fields = common;
  fields.section("reads_nothing", reads_none(interface.inputs));
  fields.list("constants", std::move(constants));
  fields.list("internals", std::move(internals));
  fields.list("inputs", slot_items(interface.inputs));
  fields.list("outputs", slot_items(interface.outputs));
  fields.list("states", slot_items(interface.states));
  return render_with_blocks("c/readable.c.mustache", std::move(fields), {{"body", &body}});
}

}  // namespace sinew::backend
