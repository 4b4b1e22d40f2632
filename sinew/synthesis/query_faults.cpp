#include "sinew/synthesis/query_faults.h"

#include <utility>

namespace sinew::synthesis {

Problem fault_in(const Query& query, const Origin& origin, std::string about, std::string what,
                 std::string remedy) {
  Problem problem{origin.place, std::move(about), std::move(what), std::move(remedy), {}, {}};
  if (origin.place.file.empty() && origin.iri.empty()) return problem;
  const std::string& node = origin.iri.empty() ? query.iri : origin.iri;
  if (!problem.iri.empty() && problem.iri != node) problem.what = problem.iri + ": " + problem.what;
  problem.iri = node;
  return problem;
}

void add_faults(Report& report, const Query& query, const Origin& origin, const Error& error) {
  for (const Problem& problem : error.problems())
    report.add(fault_in(query, origin, problem.iri, problem.what, problem.remedy));
}

}  // namespace sinew::synthesis
