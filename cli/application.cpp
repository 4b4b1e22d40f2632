#include "application.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/algorithm/attach.h"
#include "sinew/algorithm/names.h"
#include "sinew/robot/names.h"
#include "sinew/task/host_model.h"

namespace sinew::cli {
namespace {

[[noreturn]] void fail(std::string iri, std::string what, std::string remedy) {
  throw Error(Problem{{}, std::move(iri), std::move(what), std::move(remedy), {}, {}});
}

bool has_log(const program::HostPlan& plan) {
  return std::any_of(plan.externals.begin(), plan.externals.end(),
                     [](const program::External& e) { return e.operation == "log"; });
}

// Without a `log` in the algorithm, whatever the host holds is recorded. `prefix` comes before the
// names of columns: tasks call different blocks by one name.
void log_everything(program::HostPlan& plan, const std::string& prefix) {
  program::External log{"log", plan.iri, {{"label", prefix.empty() ? "all" : prefix}}, {}};
  if (!prefix.empty()) log.properties.push_back({"prefix", prefix + "/"});
  for (std::uint32_t i = 0; i < plan.blocks.size(); ++i)
    if (plan.blocks[i].role != program::Role::kConstant) log.blocks.push_back(i);
  plan.externals.push_back(std::move(log));
  plan.steps.push_back({true, static_cast<std::uint32_t>(plan.externals.size() - 1)});
}

// --- a host model ---

// All models but those that belong to other tasks.
std::unique_ptr<Models> models_of(const ModelOptions& files, const task::HostModel& host,
                                  const task::HostTask& own, const graph::Terms& terms) {
  auto models = load(files);
  graph::Transaction transaction = models->store.begin();
  for (const task::HostTask& task : host.tasks) {
    for (const graph::Id model : task.models) {
      const std::string_view iri = terms.text(model);
      const graph::Id graph = models->store.terms().find_iri(iri);
      bool is_there = false;
      std::string known;
      models->store.view().named_graphs([&](graph::Id each) {
        is_there |= each == graph;
        known += " <" + std::string(models->store.terms().text(each)) + ">";
        return true;
      });
      if (!is_there)
        fail(std::string(terms.text(task.id)), fmt::format("no file holds its model <{}>", iri),
             known.empty() ? "give the file whose \"@id\" it is" : "the files hold" + known);
      if (task.id != own.id) transaction.clear(graph);
    }
  }
  transaction.commit();
  return models;
}

std::uint32_t whole_multiple(double period, double shortest, const std::string& iri) {
  constexpr double kClose = 1e-9;
  const double ratio = period / shortest, whole = std::round(ratio);
  if (std::abs(ratio - whole) > kClose * whole || whole > 1e6)
    fail(iri, fmt::format("its period is {} times the shortest one, {} s", ratio, shortest),
         "a whole number of times, at most 1000000");
  return static_cast<std::uint32_t>(whole);
}

runtime::Reaction reaction_of(const task::HostReaction& reaction, const graph::Terms& terms) {
  using Action = task::HostReaction::Action;
  using Kind = runtime::ReactionKind;
  const Kind kind = reaction.action == Action::kStop    ? Kind::kStop
                    : reaction.action == Action::kFault ? Kind::kFault
                    : reaction.action == Action::kStart ? Kind::kStartTask
                                                        : Kind::kHaltTask;
  return {std::string(terms.text(reaction.event)), kind,
          reaction.task ? std::string(algorithm::short_name(terms.text(reaction.task))) : "",
          reaction.from_outside};
}

// The output of another task that the set point is; two are an error.
std::optional<runtime::Connection> source_of(const Application& application,
                                             const PlannedTask& sink,
                                             const program::Variable& point,
                                             const std::vector<std::string>& also) {
  std::optional<runtime::Connection> found;
  for (const PlannedTask& task : application.tasks) {
    if (&task == &sink) continue;
    for (const program::Variable& block : task.plan.blocks) {
      const bool same_number = block.iri == point.iri || (block.represents == point.represents &&
                                                          point.name.starts_with("setpoint."));
      const bool connected = std::find(also.begin(), also.end(), block.iri) != also.end() ||
                             std::find(also.begin(), also.end(), block.represents) != also.end();
      if (!block.output || block.role == program::Role::kInput ||
          block.quantity != point.quantity || !(same_number || connected))
        continue;
      if (found)
        fail(point.represents,
             fmt::format("{} of the task {} comes from {} of {} and from {} of {}", point.name,
                         sink.options.name, found->from, found->from_task, block.name,
                         task.options.name),
             "one task computes it");
      found = runtime::Connection{task.options.name, block.name, sink.options.name, point.name};
    }
  }
  return found;
}

void connect(Application& application, const task::HostModel& host, const graph::Terms& terms) {
  std::vector<bool> used(host.connections.size(), false);
  for (const PlannedTask& task : application.tasks) {
    for (const std::uint32_t at : set_points(task.plan)) {
      const program::Variable& point = task.plan.blocks[at];
      std::vector<std::string> also;
      for (std::size_t i = 0; i < host.connections.size(); ++i) {
        const std::string to(terms.text(host.connections[i].to));
        if (to != point.iri && to != point.represents) continue;
        also.emplace_back(terms.text(host.connections[i].from));
        const auto source = source_of(application, task, point, also);
        used[i] = source.has_value();
      }
      if (const auto source = source_of(application, task, point, also))
        application.connections.push_back(*source);
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    const task::HostConnection& connection = host.connections[i];
    if (!used[i])
      fail(std::string(terms.text(connection.id)),
           fmt::format("it connects <{}> to <{}>, but no two tasks have such an output and set "
                       "point of the same quantity",
                       terms.text(connection.from), terms.text(connection.to)),
           "name a number that a task hands out, and a set point of another");
  }
}

Application tasks_of(const Models& models, const ModelOptions& files, const QueryOptions& query,
                     const LiveOptions& options, const task::HostModel& host) {
  const graph::Terms& terms = models.store.terms();
  const auto text = [&](graph::Id id) { return std::string(terms.text(id)); };
  if (options.rate)
    fail(text(host.id), "its tasks state their periods, and --rate another", "leave out --rate");
  if (!query.solver.empty() || !query.query_file.empty() || !query.ask.empty())
    fail(text(host.id), "a query is named for several tasks",
         "leave out --solver, --query and --ask: each task's own solver is asked");
  Application application;
  std::vector<double> periods;
  for (const task::HostTask& task : host.tasks) {
    const auto own = models_of(files, host, task, terms);
    PlannedTask planned{{}, plan_of(*own, files, query, options, false)};
    planned.options.name = algorithm::short_name(terms.text(task.id));
    planned.options.halted = task.halted;
    const auto period = task.period_s ? task.period_s : planned.plan.period_s;
    if (!period) fail(text(task.id), "it is not said how often it runs", "state its \"period\"");
    periods.push_back(*period);
    application.tasks.push_back(std::move(planned));
  }
  application.period_s = *std::min_element(periods.begin(), periods.end());
  for (std::size_t i = 0; i < periods.size(); ++i)
    application.tasks[i].options.every =
        whole_multiple(periods[i], application.period_s, text(host.tasks[i].id));
  connect(application, host, terms);
  for (const task::HostReaction& reaction : host.reactions)
    application.reactions.push_back(reaction_of(reaction, terms));
  application.event_capacity = host.event_capacity;
  return application;
}

}  // namespace

std::vector<std::uint32_t> set_points(const program::HostPlan& plan) {
  std::vector<bool> read(plan.blocks.size(), false);
  for (const program::External& external : plan.externals)
    if (external.operation == "read")
      for (const std::uint32_t block : external.blocks) read[block] = true;
  std::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < plan.blocks.size(); ++i)
    if (plan.blocks[i].role == program::Role::kInput && !read[i]) points.push_back(i);
  return points;
}

program::HostPlan plan_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                          const LiveOptions& options, bool needs_robot) {
  const graph::Id algorithm = algorithm_of(models, files, query);
  note_held(lowered(models, algorithm, "held"));
  const graph::View view = models.store.view();
  if (!algorithm::has_robot(view, algorithm) &&
      (needs_robot || algorithm::speaks_of_joints(view, algorithm))) {
    std::string safe = options.safe;
    if (safe.empty() && options.robot == "udp")
      fail("", "no safe command is declared", "say what is commanded on a fault: --safe 0");
    if (safe.empty()) safe = "0";  // nobody is hurt by a robot that is not there
    algorithm::attach_robot(models.store, algorithm,
                            {robot::interface_iri(options.robot), parse_numbers(safe, "--safe")});
  }
  return program::plan_for_host(models.store.view(), algorithm,
                                query.solver.empty() ? "program" : query.solver, &models.places);
}

Application application_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                           const LiveOptions& options) {
  Report report;
  const auto host = task::read_host(models.store, models.places, report);
  report.throw_if_errors();
  Application application;
  if (host) {
    application = tasks_of(models, files, query, options, *host);
  } else {
    application.tasks.push_back({{kOnlyTask}, plan_of(models, files, query, options)});
    const std::optional<double> own = application.tasks.front().plan.period_s;
    constexpr double kDefaultPeriod = 0.001;
    application.period_s = options.rate ? 1 / *options.rate : own.value_or(kDefaultPeriod);
  }
  const bool logs = std::any_of(application.tasks.begin(), application.tasks.end(),
                                [](const PlannedTask& task) { return has_log(task.plan); });
  if (!options.record.empty() && !logs)
    for (PlannedTask& task : application.tasks)
      log_everything(task.plan, host ? task.options.name : "");
  return application;
}

}  // namespace sinew::cli
