#include "sinew/model/structure.h"

#include "sinew/model/structure_reader.h"

namespace sinew::model {
namespace {

int find(const std::unordered_map<Id, int>& map, Id iri) {
  const auto found = map.find(iri);
  return found == map.end() ? kNone : found->second;
}

}  // namespace

int Structure::find_link(Id iri) const { return find(link_by_iri, iri); }
int Structure::find_frame(Id iri) const { return find(frame_by_iri, iri); }

Structure read_structure(graph::Store& store, const graph::Places& places, Report& report) {
  GraphReader reader(store, places, report);
  Structure structure;
  read_links_and_frames(reader, structure);
  read_poses(reader, structure);
  read_joints(reader, structure);
  read_inertias(reader, structure);
  read_base_accelerations(reader, structure);
  report_unread(reader, structure);
  return structure;
}

}  // namespace sinew::model
