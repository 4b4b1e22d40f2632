// Reading on behalf of a component: whoever is no user of a measurement does not get it, nor an
// answer that is made from it.
//
//   Reader task(world, rights, "http://cell/task-controller", audit);
//   PreparedPose grasp = task.prepare_pose({.of = part, .with_respect_to = tool});
//   … grasp.latest_realtime(now) …
//
// A query is judged when it is prepared, by all measurements that its plan may use, constants among
// them: answering costs what it costs anybody. When the structure has changed, the new plan is
// judged before it is used. Single measurements are judged each time. What is refused is an Error
// with the measurement's IRI, who asked, and who would get it.
//
// Rights are those of when the reader was made; it must not outlive the world.
#pragma once

#include <memory>
#include <string>

#include "sinew/world/audit.h"
#include "sinew/world/rights.h"
#include "sinew/world/world.h"

namespace sinew::world {

class Reader {
 public:
  Reader(const World& world, Rights rights, std::string who,
         std::shared_ptr<Audit> audit = nullptr);

  PreparedPose prepare_pose(const PoseQuery& query) const;
  PreparedMotion prepare_motion(const PoseQuery& query) const;
  PoseAnswer pose(FrameId of, FrameId with_respect_to, Stamp now) const;

  World::Sample latest(MeasurementId measurement, Stamp now) const;
  World::Sample at(MeasurementId measurement, Stamp time) const;
  History history(MeasurementId measurement) const;
  Status read_blocks(MeasurementId measurement, std::span<const World::BlockBuffer> buffers,
                     Stamp* stamp = nullptr) const;
  // The model itself, to predict with: as good as reading.
  std::shared_ptr<const MeasurementModel> model(MeasurementId measurement) const;

 private:
  struct Judge;
  const World& world_;
  std::shared_ptr<const Judge> judge_;
  std::shared_ptr<const PlanGuard> guard_;
};

}  // namespace sinew::world
