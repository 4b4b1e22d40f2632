// From the words of a query to elements of one robot: what is wanted of which joint, frame or pair
// of frames, and which slots the planner must see to for that.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/context.h"
#include "sinew/synthesis/plan.h"
#include "sinew/synthesis/relation.h"

namespace sinew::synthesis {

// One thing that is asked: the row of the table and the element.
struct Wanted {
  const AskedQuantity* quantity;
  Id element;
  std::vector<Id> frames = {};  // the way to them matters
  bool output = true;           // false: a task needs it
};

struct Resolved {
  std::vector<Wanted> wanted;
  std::vector<Relation> relations;
  std::vector<Wish> wishes;
  bool dynamic = false;  // speaks of masses: the whole robot matters
  bool regroups = true;  // the same after inertias have been regrouped

  bool wants(std::string_view quantity) const;
};

// `more`: quantities of steps that are models. Whatever cannot be found is reported.
Resolved resolve(graph::Store& store, const graph::View& view, const Robot& robot,
                 const Query& query, std::span<const ExternalWrench> wrenches,
                 const MotionDrivers& drivers, std::span<const AskedQuantity> more, Report& report);

// What the expansion queries and conditions see of the question: sa:asks, sa:asks-QUANTITY.
void write_asks(graph::Store& store, graph::Transaction& transaction, Id algorithm,
                const Resolved& resolved, std::span<const ExternalWrench> wrenches,
                const MotionDrivers& drivers);

// Leaves what is on the way to no asked frame out of the sweeps, where masses do not matter.
void set_scope(Context& context, const Resolved& resolved);

}  // namespace sinew::synthesis
