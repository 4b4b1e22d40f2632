#include "sinew/synthesis/held.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sinew/synthesis/query_faults.h"

namespace sinew::synthesis {
namespace {

using algorithm::Block;
using algorithm::Role;
using algorithm::short_name;

bool names_all(const std::string& element) {
  return element.empty() || element == kEveryJoint || element == kEveryTip || element == kEveryLink;
}

class Holder {
 public:
  Holder(Context& context, const Resolved& resolved, const Held& held)
      : context_(context), resolved_(resolved), held_(held) {
    if (names_all(held.of)) return;
    try {
      frame_ = find_frame(context.store, context.view, held.of);
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch)
      // It is a joint, or nothing; what it is not is told where there is no block of it.
    }
  }

  // The blocks, and whether they are given; empty: there are none.
  std::vector<BlockIndex> find(bool& given) const {
    std::vector<BlockIndex> blocks = inputs();
    given = !blocks.empty();
    if (blocks.empty()) blocks = results();
    if (blocks.empty()) blocks = on_the_way();
    return blocks;
  }

  Problem fault() const {
    const auto about = [&](std::string what, std::string remedy) {
      return fault_in(context_.query, held_.origin, held_.quantity, std::move(what),
                      std::move(remedy));
    };
    if (held_.quantity == "gravity" && context_.has("base-acceleration", context_.robot.root_frame))
      return about("it is to be held, but is a constant",
                   "let it vary (it is then an input), or do not hold it");
    if (!names_all(held_.of)) {
      const Held every{held_.quantity, "", held_.origin};
      bool given = false;
      if (!Holder(context_, resolved_, every).find(given).empty())
        return about(fmt::format("it is to be held of {}, but there is none of that", held_.of),
                     "name an element that it is of, or none, for all");
    }
    return about("it is to be held, but is neither given, nor asked, nor computed on the way",
                 fmt::format("hold one of {}", fmt::join(known(), ", ")));
  }

 private:
  bool is_named(Id element) const {
    const std::string_view iri = context_.view.terms().text(element);
    return iri == held_.of || algorithm::is_called(iri, held_.of) || (frame_ && element == frame_);
  }

  // A block of the element, or of a frame of the link, that the query names. A block's own name
  // ends with what the query called its element.
  bool is_of(const Block& block) const {
    if (names_all(held_.of) || is_named(block.represents)) return true;
    const std::size_t dot = block.name.find('.');
    if (dot == std::string::npos) return false;
    const std::string_view label = std::string_view(block.name).substr(dot + 1);
    const std::string_view name = short_name(held_.of);
    return label == name || (label.starts_with(name) && label[name.size()] == '.');
  }

  template <typename Fits>
  std::vector<BlockIndex> all(Fits fits) const {
    std::vector<BlockIndex> found;
    const auto& blocks = context_.builder.algorithm().blocks;
    for (BlockIndex i = 0; i < blocks.size(); ++i)
      if (fits(blocks[i]) && is_of(blocks[i])) found.push_back(i);
    return found;
  }

  std::vector<BlockIndex> inputs() const {
    const GivenQuantity* row = find_given(held_.quantity);
    if (row == nullptr) return {};
    const bool gravity = held_.quantity == "gravity";
    return all([&](const Block& block) {
      return block.role == Role::kInput &&
             (gravity ? block.slot == "gravity"
                      : block.slot == row->slot || (row->slot == "acceleration-energy" &&
                                                    block.slot == "constraint-direction"));
    });
  }

  std::vector<BlockIndex> results() const {
    const auto wanted =
        std::find_if(resolved_.wanted.begin(), resolved_.wanted.end(),
                     [&](const Wanted& one) { return one.quantity->name == held_.quantity; });
    if (wanted == resolved_.wanted.end()) return {};
    const AskedQuantity& row = *wanted->quantity;
    return all([&](const Block& block) {
      return block.output && block.role == Role::kInternal &&
             (block.name.substr(0, block.name.find('.')) == row.slot || block.name == row.name);
    });
  }

  std::vector<BlockIndex> on_the_way() const {
    return all([&](const Block& block) {
      return block.role == Role::kInternal &&
             (block.quantity->name == held_.quantity || block.slot == held_.quantity);
    });
  }

  std::set<std::string> known() const {
    std::set<std::string> names;
    for (const Block& block : context_.builder.algorithm().blocks)
      if (block.role == Role::kInternal) names.emplace(block.quantity->name);
    for (const Given& given : context_.query.given)
      if (given.quantity != "gravity" || given.varies) names.insert(given.quantity);
    return names;
  }

  Context& context_;
  const Resolved& resolved_;
  const Held& held_;
  Id frame_ = {};  // where a frame or link is named
};

}  // namespace

std::vector<std::string> hold(Context& context, const Resolved& resolved, Report& report) {
  std::vector<std::string> why;
  for (const Held& held : context.query.held) {
    const Holder holder(context, resolved, held);
    bool given = false;
    const std::vector<BlockIndex> blocks = holder.find(given);
    if (blocks.empty()) {
      report.add(holder.fault());
      continue;
    }
    for (const BlockIndex block : blocks) context.builder.hold(block);
    const std::string& whose = held.origin.iri.empty() ? context.query.iri : held.origin.iri;
    why.push_back(fmt::format("held: {}{} ({} data block{}){}: {}", held.quantity,
                              held.of.empty() ? "" : " of " + held.of, blocks.size(),
                              blocks.size() == 1 ? "" : "s",
                              whose.empty() ? "" : ", as " + whose + " says",
                              given ? "changes slowly; the update computes what depends on it alone"
                                    : "keeps its value from one update to the next"));
  }
  return why;
}

}  // namespace sinew::synthesis
