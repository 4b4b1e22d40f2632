#include "sinew/algorithm/attach.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "sinew/algorithm/builder.h"
#include "sinew/algorithm/read.h"
#include "sinew/base/error.h"

namespace sinew::algorithm {
namespace {

using graph::Id;

constexpr std::array<std::string_view, 4> kMeasured = {"joint-position", "joint-velocity",
                                                       "floating-position", "floating-velocity"};
// What a joint does, not what it should do: set points have slots of other names.
constexpr std::array<std::string_view, 2> kMeasuredSlots = {"position", "velocity"};
constexpr std::string_view kCommanded = "joint-force";

bool is_robot(const Closure& closure) {
  return closure.op->name == "read" || closure.op->name == "write";
}

class Attacher {
 public:
  Attacher(graph::Store& store, const Algorithm& model)
      : terms_(store.terms()), names_(terms_), model_(model), transaction_(store.begin()) {}

  void run(const RobotAttachment& attachment, const std::vector<Id>& measured,
           const std::vector<Id>& commanded) {
    const Id read = closure("read", measured, attachment);
    const Id write = closure("write", commanded, attachment);
    if (write) {
      std::vector<Id> safe;
      for (const double number : attachment.safe) safe.push_back(terms_.real(number));
      add(write, sa("safe"), list(safe));
    }
    std::vector<Id> chain;
    if (read) chain.push_back(read);
    for (const std::uint32_t at : model_.schedule) chain.push_back(model_.closures[at].id);
    if (write) chain.push_back(write);
    replace_schedule(chain);
    transaction_.commit();
  }

 private:
  Id sa(std::string_view name) {
    return terms_.iri(std::string(kAlgorithmNamespace) + std::string(name));
  }
  void add(Id subject, Id predicate, Id object) {
    transaction_.add({subject, predicate, object, model_.id});
  }
  Id list(const std::vector<Id>& items) {
    return write_list(terms_, transaction_, names_, model_.id, items);
  }

  Id closure(std::string_view operation, const std::vector<Id>& blocks,
             const RobotAttachment& attachment) {
    if (blocks.empty()) return {};
    const Operator& op = *find_operator(operation);
    const Id type = terms_.iri(op.iri), interface = terms_.iri(attachment.interface);
    const Id id = terms_.derived(type, {model_.id, interface});
    add(model_.id, names_.closure, id);
    add(id, names_.type, type);
    add(id, terms_.iri(op.ports[0].iri), list(blocks));
    add(id, sa("interface"), interface);
    return id;
  }

  void replace_schedule(const std::vector<Id>& chain) {
    Id schedule;
    transaction_.view().match_in(model_.id, names_.schedule, {}, model_.id,
                                 [&](const graph::Quad& quad) {
                                   schedule = quad.object;
                                   return false;
                                 });
    std::vector<graph::Quad> old;
    transaction_.view().match_in(schedule, names_.trigger_chain, {}, model_.id,
                                 [&](const graph::Quad& quad) {
                                   old.push_back(quad);
                                   return false;
                                 });
    for (Id node = old.front().object; node != names_.nil;) {
      Id next = names_.nil;
      transaction_.view().match_in(node, {}, {}, model_.id, [&](const graph::Quad& quad) {
        old.push_back(quad);
        if (quad.predicate == names_.rest) next = quad.object;
        return true;
      });
      node = next;
    }
    for (const graph::Quad& quad : old) transaction_.remove(quad);
    add(schedule, names_.trigger_chain, list(chain));
  }

  graph::Terms& terms_;
  Names names_;
  const Algorithm& model_;
  graph::Transaction transaction_;
};

struct Joints {
  std::vector<Id> measured, commanded;
};

Joints joints_of(const Algorithm& model) {
  Joints joints;
  for (const Block& block : model.blocks) {
    const std::string_view quantity = block.quantity->name;
    if (block.role == Role::kInput &&
        std::find(kMeasured.begin(), kMeasured.end(), quantity) != kMeasured.end() &&
        std::find(kMeasuredSlots.begin(), kMeasuredSlots.end(), block.slot) != kMeasuredSlots.end())
      joints.measured.push_back(block.id);
    if (block.output && block.role != Role::kInput && quantity == kCommanded)
      joints.commanded.push_back(block.id);
  }
  return joints;
}

[[noreturn]] void fail(const graph::Store& store, Id algorithm, std::string what,
                       std::string remedy) {
  throw Error(Problem{
      {}, std::string(store.terms().text(algorithm)), std::move(what), std::move(remedy), {}, {}});
}

}  // namespace

bool has_robot(const graph::View& view, Id algorithm) {
  Report ignored;
  const Algorithm model = read(view, algorithm, ignored);
  return std::any_of(model.closures.begin(), model.closures.end(), is_robot);
}

bool speaks_of_joints(const graph::View& view, Id algorithm) {
  Report ignored;
  const Joints joints = joints_of(read(view, algorithm, ignored));
  return !joints.measured.empty() || !joints.commanded.empty();
}

void attach_robot(graph::Store& store, Id algorithm, const RobotAttachment& attachment) {
  const Algorithm model = read_checked(store.view(), algorithm);
  if (std::any_of(model.closures.begin(), model.closures.end(), is_robot))
    fail(store, algorithm, "the algorithm reads from or writes to a robot already",
         "leave the robot out, or take an algorithm without one");
  const auto [measured, commanded] = joints_of(model);
  if (measured.empty() && commanded.empty())
    fail(store, algorithm, "the algorithm has no joint among its inputs and outputs",
         "ask for joint forces, or give joint positions");
  if (!commanded.empty() && attachment.safe.size() != 1 &&
      attachment.safe.size() != commanded.size())
    fail(store, algorithm,
         "the safe command has " + std::to_string(attachment.safe.size()) + " numbers for " +
             std::to_string(commanded.size()) + " joint forces",
         "declare one number for each, or one for all");
  Attacher(store, model).run(attachment, measured, commanded);
}

}  // namespace sinew::algorithm
