// The edge over which most steps go: from a body's frame across a joint to the successor's frame.
#pragma once

#include <string>
#include <string_view>

#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

#define SINEW_TREE_PREFIX "PREFIX tree: <https://w3id.org/sinew/kinematic-tree#>\n"

// From ?node to each ?child.
inline constexpr std::string_view kAcrossJoints = SINEW_TREE_PREFIX R"(
SELECT ?child ?joint ?kind ?joint_frame ?placement ?predecessor ?successor ?index WHERE {
  ?joint tree:predecessor-frame ?node ; tree:successor-frame ?child ;
         tree:joint-frame ?joint_frame ; tree:placement ?placement ; tree:index ?index ; a ?kind .
  VALUES ?kind { tree:Revolute tree:Prismatic tree:Floating }
  ?predecessor tree:frame ?node .
  ?successor tree:frame ?child .
})";

#define SINEW_ASKS_PREFIX SINEW_TREE_PREFIX "PREFIX sa: <https://w3id.org/sinew/algorithm#>\n"

// From a body's frame to the frames fixed to it that are asked for.
inline constexpr std::string_view kToAskedFrames = SINEW_ASKS_PREFIX R"(
SELECT ?child ?placement ?body WHERE {
  ?child tree:fixed-to ?node ; tree:placement ?placement .
  ?algorithm sa:asks ?child .
  ?body tree:frame ?node .
})";

// Conditions on ?node, or on an edge's ?parent.
inline constexpr std::string_view kIsRoot =
    SINEW_TREE_PREFIX "ASK { FILTER NOT EXISTS { ?joint tree:successor-frame ?node } }";
inline constexpr std::string_view kParentIsRoot =
    SINEW_TREE_PREFIX "ASK { FILTER NOT EXISTS { ?joint tree:successor-frame ?parent } }";
inline constexpr std::string_view kParentIsNotRoot =
    SINEW_TREE_PREFIX "ASK { ?joint tree:successor-frame ?parent }";
inline constexpr std::string_view kIsNotRoot =
    SINEW_TREE_PREFIX "ASK { ?joint tree:successor-frame ?node }";
inline constexpr std::string_view kIsLeaf =
    SINEW_TREE_PREFIX "ASK { FILTER NOT EXISTS { ?joint tree:predecessor-frame ?node } }";
inline constexpr std::string_view kHasNoInertia = SINEW_TREE_PREFIX
    "ASK { FILTER NOT EXISTS { ?body tree:frame ?node ; tree:inertia ?inertia } }";

// The body whose frame ?node is, and what is known of it.
inline constexpr std::string_view kBodyOfNode =
    SINEW_TREE_PREFIX "SELECT ?body WHERE { ?body tree:frame ?node }";

// "joint-position", or "floating-position" of a floating base; likewise velocity, acceleration,
// force.
std::string_view joint_quantity_name(std::string_view kind, std::string_view what);

// A row of kAcrossJoints.
struct JointEdge {
  JointEdge(const Context& context, const Visit& visit);

  Id parent, child;           // frames of the two bodies: F_P, F_C
  Id joint, joint_frame;      // F_J, fixed to the predecessor
  Id placement;               // coordinate node: pose of F_J in F_P
  Id predecessor, successor;  // bodies
  std::string kind;           // "revolute", "prismatic", "floating"
  std::string_view label;     // see Context::label

  bool floats() const { return kind == "floating"; }
  // The data block of the joint's "position", "velocity", "acceleration" or "force" in some slot.
  algorithm::BlockSpec coordinate(std::string_view slot, std::string_view what) const;
};

}  // namespace sinew::synthesis
