#include <fmt/format.h>

#include <algorithm>

#include "sinew/graph/standard_iris.h"
#include "sinew/task/host_model.h"
#include "sinew/task/reader.h"
#include "sinew/vocab/vocab.h"

namespace sinew::task {
namespace {

namespace ho = vocab::ho;

constexpr data::Dimension kTime = {{0, 0, 1}};

// The items of a list; empty and an error where it is broken.
std::vector<Id> list(Reader& reader, Id node, std::string_view property) {
  const Id head = reader.optional(node, property);
  if (!head) return {};
  const Id first = reader.iri(graph::kRdfFirst);
  const Id rest = reader.iri(graph::kRdfRest);
  const Id nil = reader.iri(graph::kRdfNil);
  constexpr std::size_t kMaximumItems = 1000;
  std::vector<Id> items;
  for (Id at = head; at != nil; at = reader.graph.view.object(at, rest)) {
    const Id item = reader.graph.view.object(at, first);
    if (!item || items.size() == kMaximumItems) {
      reader.error(node, property,
                   fmt::format("this is no list of at most {} items", kMaximumItems),
                   "list them in brackets: [ ... ]");
      return {};
    }
    items.push_back(item);
  }
  return items;
}

bool is_true(Reader& reader, Id node, std::string_view property) {
  const Id value = reader.optional(node, property);
  return value && reader.graph.text(value) == "true";
}

HostTask read_host_task(Reader& reader, Id node) {
  HostTask task;
  task.id = node;
  if (!reader.is_a(node, ho::HostTask))
    reader.error(node, "", "it stands among the tasks of a host, but is none",
                 "give it the type HostTask");
  task.models = reader.objects(node, ho::model);
  if (task.models.empty())
    reader.error(node, ho::model, "it is not said which models make this task",
                 "name them by the \"@id\" of their files");
  task.halted = is_true(reader, node, ho::halted);
  if (const Id period = reader.optional_number(node, ho::period, "the period")) {
    const Quantity& quantity = reader.task.quantities.at(period);
    if (quantity.dimension != kTime || !quantity.value || *quantity.value <= 0)
      reader.error(period, "", "this is no period", "state a constant time above zero");
    else
      task.period_s = quantity.value;
  }
  return task;
}

std::optional<HostReaction> read_reaction(Reader& reader, Id node, const HostModel& host) {
  using Action = HostReaction::Action;
  HostReaction reaction;
  reaction.id = node;
  reaction.event = reader.required(node, ho::event, "the event");
  const Id action = reader.required(node, ho::action, "what the event leads to");
  constexpr std::pair<std::string_view, Action> kActions[] = {{ho::stop, Action::kStop},
                                                              {ho::fault, Action::kFault},
                                                              {ho::start, Action::kStart},
                                                              {ho::halt, Action::kHalt}};
  const auto* known = std::find_if(std::begin(kActions), std::end(kActions), [&](const auto& one) {
    return action == reader.iri(one.first);
  });
  if (!reaction.event || !action) return std::nullopt;
  if (known == std::end(kActions)) {
    reader.error(node, ho::action, fmt::format("<{}> is no action", reader.graph.text(action)),
                 "stop, fault, start or halt");
    return std::nullopt;
  }
  reaction.action = known->second;
  reaction.from_outside = is_true(reader, node, ho::from_outside);
  const bool of_task = reaction.action == Action::kStart || reaction.action == Action::kHalt;
  if (of_task) {
    reaction.task = reader.required(node, ho::task, "the task that it starts or halts");
    if (!reaction.task) return std::nullopt;
    const bool is_one = std::any_of(host.tasks.begin(), host.tasks.end(),
                                    [&](const HostTask& task) { return task.id == reaction.task; });
    if (!is_one)
      reader.error(node, ho::task,
                   fmt::format("<{}> is no task of the host", reader.graph.text(reaction.task)),
                   "name one of its \"tasks\"");
  } else if (!reader.objects(node, ho::task).empty()) {
    reader.error(node, ho::task, "it stops or faults the whole host, not a task",
                 "leave the task out, or \"halt\" it");
  }
  return reaction;
}

void read_capacity(Reader& reader, HostModel& host) {
  const Id capacity = reader.optional(host.id, ho::event_capacity);
  if (!capacity) return;
  const auto number = reader.graph.view.terms().integer_value(capacity);
  if (!number || *number < 1)
    reader.error(host.id, ho::event_capacity, "its queue of events has no room", "1 or more");
  else
    host.event_capacity = static_cast<std::size_t>(*number);
}

// A model belongs to one task; what belongs to none (the robot) is everybody's.
void check_models(Reader& reader, const HostModel& host) {
  for (std::size_t i = 0; i < host.tasks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (const Id model : host.tasks[i].models) {
        const auto& others = host.tasks[j].models;
        if (std::find(others.begin(), others.end(), model) != others.end())
          reader.error(host.tasks[i].id, ho::model,
                       fmt::format("<{}> belongs to <{}> as well", reader.graph.text(model),
                                   reader.graph.text(host.tasks[j].id)),
                       "a model belongs to one task, or is named by none and belongs to all");
      }
}

}  // namespace

std::optional<HostModel> read_host(graph::Store& store, const graph::Places& places,
                                   Report& report) {
  Reader reader{model::GraphReader(store, places, report), store};
  const std::vector<Id> hosts = reader.graph.all(reader.iri(ho::Host));
  if (hosts.empty()) return std::nullopt;
  if (hosts.size() > 1) reader.error(hosts[1], "", "a second host", "name one at a time");
  HostModel host;
  host.id = hosts.front();
  for (const Id node : list(reader, host.id, ho::tasks)) {
    if (std::any_of(host.tasks.begin(), host.tasks.end(),
                    [&](const HostTask& task) { return task.id == node; }))
      reader.error(node, "", "the host lists it twice", "once is right");
    else
      host.tasks.push_back(read_host_task(reader, node));
  }
  if (host.tasks.empty())
    reader.error(host.id, ho::tasks, "a host without tasks", "list at least one HostTask");
  check_models(reader, host);
  for (const Id node : reader.objects(host.id, ho::connection)) {
    const HostConnection connection{node,
                                    reader.required(node, ho::from, "the number that is handed on"),
                                    reader.required(node, ho::to, "the set point that it goes to")};
    if (connection.from && connection.to) host.connections.push_back(connection);
  }
  for (const Id node : list(reader, host.id, ho::reactions))
    if (const auto reaction = read_reaction(reader, node, host))
      host.reactions.push_back(*reaction);
  read_capacity(reader, host);
  return host;
}

}  // namespace sinew::task
