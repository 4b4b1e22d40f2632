// What is asked of a robot, what is given, and how to go about it. A query is a model (JSON-LD,
// type sq:Query); this is the same as plain values. The named queries of solvers/ are such models
// with blanks: base, tips and gravity.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::synthesis {

inline constexpr std::string_view kQueryNamespace = "https://w3id.org/sinew/query#";

// Elements are named by IRI, or by its last segment where that is unambiguous. These stand for
// several.
inline constexpr std::string_view kEveryJoint = "every-joint";
inline constexpr std::string_view kEveryTip = "every-tip";  // the query's tips, or every leaf

struct Asked {
  std::string quantity;  // a row of asked.cpp: "pose", "joint-force", "mass-matrix", ...
  std::string of;        // frame, joint or link; kEveryTip, kEveryJoint; empty for the whole robot
  std::string seen_by;   // of motions of frames: "base" (the default), or "itself" for the frame
};

struct Given {
  std::string quantity;  // a row of asked.cpp: "joint-position", "gravity", "external-wrench", ...
  std::string of;        // as above
};

struct Query {
  std::string name;  // of the program that answers it
  std::vector<Asked> asked;
  std::vector<Given> given;

  std::string base;               // a link or frame; empty: the tree's root
  std::vector<std::string> tips;  // empty: every leaf
  // The gravity vector [m/s^2] seen from the base; overrides the model's.
  std::optional<std::array<double, 3>> gravity;
  bool floating = false;  // the base moves freely: its pose, twist and acceleration come first
  // Inertias may be regrouped for speed, where nothing that is asked could tell (regroup.h).
  bool regroup = true;
  std::string sweeps;  // name of a hand-written sweep configuration; empty: planned
};

// The same facts in one line, always in the same words: what the algorithm's IRI is derived from.
std::string canonical_text(const Query& query);

}  // namespace sinew::synthesis
