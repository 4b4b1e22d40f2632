// The Gen3 that the project ships, and algorithms for it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "sinew/algorithm/attach.h"
#include "sinew/base/error.h"
#include "sinew/model/load.h"
#include "sinew/model/normalise.h"
#include "sinew/program/host_plan.h"
#include "sinew/robot/names.h"
#include "sinew/runtime/host.h"
#include "sinew/synthesis/read_query.h"
#include "sinew/synthesis/synthesise.h"

namespace sinew::robot::test {

struct Gen3 {
  Gen3() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(SINEW_SOURCE_DIR "/robots/gen3"))
      if (entry.path().extension() == ".jsonld") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    Report report;
    model::load_files(files, {}, store, places, report);
    tree = model::normalise(store, places, {}, report);
    report.throw_if_errors();
    model::write(tree, store);
  }

  // The algorithm of a named solver, with that interface around it.
  program::HostPlan plan(const std::string& solver, const std::string& interface) {
    const synthesis::Query query = synthesis::named_query(solver);
    const graph::Id algorithm = synthesis::synthesise(store, query).algorithm;
    algorithm::attach_robot(store, algorithm, {interface_iri(interface), {0.0}});
    return program::plan_for_host(store.view(), algorithm, solver);
  }

  // A host with one task, "main", that runs it; not yet configured.
  std::unique_ptr<runtime::Host> host(const std::string& solver, const std::string& interface,
                                      std::shared_ptr<runtime::RobotInterface> robot,
                                      runtime::HostOptions options = {}) {
    options.real_time = false;
    auto host = std::make_unique<runtime::Host>(options);
    host->bindings().robots[interface_iri(interface)] = std::move(robot);
    host->add_task({"main", 1},
                   runtime::Executable::prepare(plan(solver, interface), host->bindings(),
                                                {.interpret = true}));
    return host;
  }

  graph::Store store;
  graph::Places places;
  model::Tree tree;
};

}  // namespace sinew::robot::test
