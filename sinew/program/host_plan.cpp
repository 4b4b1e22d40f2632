#include "sinew/program/host_plan.h"

#include <algorithm>
#include <unordered_map>

#include "sinew/algorithm/read.h"
#include "sinew/base/error.h"
#include "sinew/program/interface.h"
#include "sinew/program/kernels.h"
#include "sinew/program/lower.h"

namespace sinew::program {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

bool writes(const Closure& closure, std::size_t argument) {
  return find_kernel(closure.operation)->port(argument, closure.arguments.size()).output;
}

// Which variables each part of the schedule reads and writes, and cuts the parts out.
class Cutter {
 public:
  Cutter(const Program& whole, HostPlan& plan)
      : whole_(whole),
        plan_(plan),
        block_(whole.variables.size(), kNone),
        part_(whole.closures.size(), 0),
        last_part_read_(whole.variables.size(), 0) {
    for (std::uint32_t i = 0; i < whole.variables.size(); ++i) {
      const Variable& variable = whole.variables[i];
      if (variable.role == Role::kInput || variable.role == Role::kState || variable.output)
        hold(i);
    }
  }

  // The part that a closure of the whole belongs to; parts count from 0 in schedule order.
  void assign(std::uint32_t closure, std::uint32_t part) { part_[closure] = part; }

  void cut(std::uint32_t parts) {
    for (const std::uint32_t index : whole_.schedule)
      for (const std::uint32_t argument : whole_.closures[index].arguments)
        last_part_read_[argument] = std::max(last_part_read_[argument], part_[index]);
    for (std::uint32_t part = 0; part < parts; ++part) plan_.segments.push_back(segment(part));
  }

  std::uint32_t block_of(std::uint32_t variable) const { return block_[variable]; }

 private:
  void hold(std::uint32_t variable) {
    if (block_[variable] != kNone) return;
    block_[variable] = static_cast<std::uint32_t>(plan_.blocks.size());
    plan_.blocks.push_back(whole_.variables[variable]);
  }

  Segment segment(std::uint32_t part) {
    Segment result;
    Program& program = result.program;
    program.name = whole_.name;
    program.iri = whole_.iri;
    std::vector<std::uint32_t> now(whole_.variables.size(), kNone);  // variable of the segment
    std::vector<std::uint32_t> block_of;                             // of each of its variables

    const auto take = [&](std::uint32_t variable, Role role, bool output, const char* suffix) {
      Variable copy = whole_.variables[variable];
      copy.role = role;
      copy.output = output;
      copy.name += suffix;
      if (role != Role::kConstant) copy.value.clear();
      now[variable] = static_cast<std::uint32_t>(program.variables.size());
      program.variables.push_back(std::move(copy));
      block_of.push_back(block_[variable]);
      return now[variable];
    };
    // Inputs and outputs come in the order of the whole program's variables.
    const Use use = use_of(part);
    std::vector<std::uint32_t> written(whole_.variables.size(), kNone);
    for (std::uint32_t i = 0; i < whole_.variables.size(); ++i) {
      const Variable& variable = whole_.variables[i];
      const bool from_outside = use.read_first[i] && variable.role != Role::kConstant;
      if (from_outside) take(i, Role::kInput, false, "");
      if (!use.written[i]) continue;
      const bool kept =
          variable.role == Role::kState || variable.output || last_part_read_[i] > part;
      if (kept) hold(i);
      const std::uint32_t before = now[i];
      written[i] = take(i, Role::kInternal, kept, before == kNone ? "" : ".next");
      now[i] = before;
    }
    for (const std::uint32_t index : whole_.schedule) {
      if (part_[index] != part) continue;
      Closure closure = whole_.closures[index];
      for (std::size_t at = 0; at < closure.arguments.size(); ++at) {
        const std::uint32_t argument = closure.arguments[at];
        if (writes(closure, at)) continue;
        if (now[argument] == kNone)  // a constant
          take(argument, whole_.variables[argument].role, false, "");
        closure.arguments[at] = now[argument];
      }
      for (std::size_t at = 0; at < closure.arguments.size(); ++at) {
        const std::uint32_t argument = whole_.closures[index].arguments[at];
        if (!writes(closure, at)) continue;
        now[argument] = written[argument];
        closure.arguments[at] = written[argument];
      }
      program.schedule.push_back(static_cast<std::uint32_t>(program.closures.size()));
      program.closures.push_back(std::move(closure));
    }
    const Interface interface = interface_of(program);
    for (const Slot& slot : interface.inputs) result.inputs.push_back(block_of[slot.variable]);
    for (const Slot& slot : interface.outputs)
      result.outputs.push_back(block_of_written(slot.variable, written));
    return result;
  }

  struct Use {
    std::vector<bool> read_first, written;  // by variable
  };
  Use use_of(std::uint32_t part) const {
    Use use{std::vector<bool>(whole_.variables.size()), std::vector<bool>(whole_.variables.size())};
    for (const std::uint32_t index : whole_.schedule) {
      if (part_[index] != part) continue;
      const Closure& closure = whole_.closures[index];
      for (std::size_t at = 0; at < closure.arguments.size(); ++at)
        if (!writes(closure, at) && !use.written[closure.arguments[at]])
          use.read_first[closure.arguments[at]] = true;
      for (std::size_t at = 0; at < closure.arguments.size(); ++at)
        if (writes(closure, at)) use.written[closure.arguments[at]] = true;
    }
    return use;
  }

  // Outputs are held after their variable was made; look their block up again.
  std::uint32_t block_of_written(std::uint32_t variable,
                                 const std::vector<std::uint32_t>& written) const {
    for (std::uint32_t i = 0; i < written.size(); ++i)
      if (written[i] == variable) return block_[i];
    return kNone;
  }

  const Program& whole_;
  HostPlan& plan_;
  std::vector<std::uint32_t> block_;           // of each variable of the whole, kNone: inside
  std::vector<std::uint32_t> part_;            // of each closure of the whole
  std::vector<std::uint32_t> last_part_read_;  // of each variable
};

// The order of one stretch between two probes: reads, the pure part, checks and logs, and writes
// after the checks.
void append_stretch(HostPlan& plan, const std::vector<std::uint32_t>& reads, std::uint32_t segment,
                    std::vector<std::uint32_t> others) {
  for (const std::uint32_t read : reads) plan.steps.push_back({true, read});
  if (segment != kNone) plan.steps.push_back({false, segment});
  std::stable_partition(others.begin(), others.end(),
                        [&](std::uint32_t i) { return plan.externals[i].operation != "write"; });
  for (const std::uint32_t other : others) plan.steps.push_back({true, other});
}

}  // namespace

const std::string* External::property(std::string_view name) const {
  for (const algorithm::Property& property : properties)
    if (property.name == name) return &property.value;
  return nullptr;
}

HostPlan plan_for_host(const graph::View& view, graph::Id algorithm, std::string_view name,
                       const graph::Places* places) {
  const algorithm::Algorithm model = algorithm::read_checked(view, algorithm, places);
  const graph::Terms& terms = view.terms();
  const Program whole = lower(model, terms, name);
  HostPlan plan;
  plan.name = whole.name;
  plan.iri = whole.iri;
  plan.period_s = model.period_s;
  Cutter cutter(whole, plan);

  std::unordered_map<std::string_view, std::uint32_t> closures, variables;
  for (std::uint32_t i = 0; i < whole.closures.size(); ++i) closures[whole.closures[i].iri] = i;
  for (std::uint32_t i = 0; i < whole.variables.size(); ++i) variables[whole.variables[i].iri] = i;

  Report report;
  const auto external_of = [&](const algorithm::Closure& closure) {
    External external{
        std::string(closure.op->name), std::string(terms.text(closure.id)), closure.properties, {}};
    for (const std::uint32_t argument : closure.arguments) {
      const algorithm::Block& block = model.blocks[argument];
      if (block.role == algorithm::Role::kConstant) {
        report.error({}, external.iri, external.operation + ": " + block.name + " is a constant",
                     "leave it out: it never changes");
        continue;
      }
      external.blocks.push_back(cutter.block_of(variables.at(terms.text(block.id))));
    }
    return external;
  };

  // Stretches between probes, each with at most one pure part.
  std::uint32_t parts = 0;
  bool pure = false;
  std::vector<std::uint32_t> reads, others;
  const auto end_stretch = [&] {
    append_stretch(plan, reads, pure ? parts++ : kNone, others);
    reads.clear();
    others.clear();
    pure = false;
  };
  for (const std::uint32_t scheduled : model.schedule) {
    const algorithm::Closure& closure = model.closures[scheduled];
    if (!closure.op->external) {
      const auto found = closures.find(terms.text(closure.id));
      if (found == closures.end()) continue;  // nothing depends on it
      cutter.assign(found->second, parts);
      pure = true;
      continue;
    }
    const auto index = static_cast<std::uint32_t>(plan.externals.size());
    plan.externals.push_back(external_of(closure));
    const std::string& operation = plan.externals.back().operation;
    if (operation == "read") {
      reads.push_back(index);
    } else if (operation == "probe-time") {
      end_stretch();
      plan.steps.push_back({true, index});
    } else {
      others.push_back(index);
    }
  }
  end_stretch();
  for (const algorithm::Block& block : model.blocks) {
    const auto found = variables.find(terms.text(block.id));
    if (!block.at_swap || found == variables.end()) continue;
    const algorithm::AtSwap& rule = *block.at_swap;
    plan.swap_rules.push_back({cutter.block_of(found->second), rule.kind,
                               rule.from ? std::string(terms.text(rule.from)) : "", rule.op,
                               rule.factor, rule.factor_unit});
  }
  report.throw_if_errors();
  cutter.cut(parts);
  return plan;
}

HostPlan plan_for_host(const Program& program) {
  HostPlan plan;
  plan.name = program.name;
  plan.iri = program.iri;
  Cutter cutter(program, plan);
  cutter.cut(1);
  plan.steps.push_back({false, 0});
  return plan;
}

}  // namespace sinew::program
