#include "sinew/program/lower.h"

#include <utility>

#include "sinew/algorithm/read.h"
#include "sinew/program/dead_closures.h"

namespace sinew::program {
namespace {

using algorithm::Attribute;

Role role_of(algorithm::Role role) {
  switch (role) {
    case algorithm::Role::kInput:
      return Role::kInput;
    case algorithm::Role::kConstant:
      return Role::kConstant;
    case algorithm::Role::kInternal:
      return Role::kInternal;
    case algorithm::Role::kState:
      return Role::kState;
  }
  return Role::kInternal;
}

// Directions of a pose's coordinates are those of the frame that it is with respect to.
graph::Id frame_of(const algorithm::Block& block) {
  const graph::Id seen_by = block.symbols[static_cast<std::size_t>(Attribute::kSeenBy)];
  return seen_by ? seen_by : block.symbols[static_cast<std::size_t>(Attribute::kWrt)];
}

std::string text(const graph::Terms& terms, graph::Id id) {
  return id ? std::string(terms.text(id)) : std::string();
}

Variable variable_of(const graph::Terms& terms, algorithm::Block&& block) {
  Variable variable;
  variable.name = std::move(block.name);
  variable.iri = text(terms, block.id);
  variable.represents = text(terms, block.represents);
  variable.quantity = block.quantity->name;
  variable.unit = std::move(block.unit);
  if (block.size > 1) variable.frame = text(terms, frame_of(block));
  variable.role = role_of(block.role);
  variable.output = block.output;
  variable.held = block.held;
  variable.size = block.size;
  variable.value = std::move(block.value);
  return variable;
}

}  // namespace

Program lower(const graph::View& view, graph::Id algorithm, std::string_view name,
              const graph::Places* places) {
  return lower(algorithm::read_checked(view, algorithm, places), view.terms(), name);
}

Program lower(const algorithm::Algorithm& model, const graph::Terms& terms, std::string_view name) {
  return lower(algorithm::Algorithm(model), terms, name);
}

Program lower(algorithm::Algorithm&& model, const graph::Terms& terms, std::string_view name) {
  Program program;
  program.name = name;
  program.iri = text(terms, model.id);
  program.variables.reserve(model.blocks.size());
  for (algorithm::Block& block : model.blocks)
    program.variables.push_back(variable_of(terms, std::move(block)));
  program.closures.reserve(model.schedule.size());
  for (const std::uint32_t scheduled : model.schedule) {
    algorithm::Closure& closure = model.closures[scheduled];
    if (closure.op->external) {
      for (const std::uint32_t taken : closure.arguments)
        if (program.variables[taken].role == Role::kInternal)
          program.variables[taken].output = true;
      continue;
    }
    program.schedule.push_back(static_cast<std::uint32_t>(program.closures.size()));
    program.closures.push_back({std::string(closure.op->name), text(terms, closure.id),
                                text(terms, closure.step), text(terms, closure.about),
                                std::move(closure.arguments)});
  }
  return without_dead_closures(std::move(program));
}

}  // namespace sinew::program
