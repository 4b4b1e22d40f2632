#include "sinew/synthesis/whole_robot.h"

#include "sinew/synthesis/composite.h"
#include "sinew/synthesis/joint_edge.h"

namespace sinew::synthesis {

using algorithm::BlockSpec;

BlockSpec whole(const Context& context, std::string_view slot, std::string_view quantity) {
  const Id body = context.robot.root_body, frame = context.robot.root_frame;
  BlockSpec spec = {.slot = slot,
                    .represents = body,
                    .quantity = quantity,
                    .of = body,
                    .label = algorithm::kWholeRobot};
  spec.wrt = spec.seen_by = spec.reference = frame;
  return spec;
}

BlockIndex total_inertia(Context& context) {
  return composite_so_far(context, context.robot.root_frame, context.robot.root_body);
}

Step at_root(std::string name, std::string purpose, std::vector<std::string> needs,
             std::string gives, Pass configure, Pass compute) {
  return {.name = std::move(name),
          .purpose = std::move(purpose),
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = std::move(needs),
          .may_use = {},
          .gives = {std::move(gives)},
          .visitors = {{Where::kNode,
                        {std::string(kIsRoot)},
                        std::string(kBodyOfNode),
                        std::move(configure),
                        std::move(compute)}}};
}

void configure_columns(Context& context, const ColumnsOfJoints& matrix, const BlockSpec& common) {
  const graph::Terms& terms = context.view.terms();
  std::uint32_t columns = 0;
  for (const RobotJoint& joint : context.robot.joints) {
    const bool floats = joint.kind == "floating";
    columns += floats ? 6 : 1;
    BlockSpec spec = common;
    spec.slot = matrix.column;
    spec.quantity = floats ? matrix.block_quantity : matrix.column_quantity;
    spec.represents = joint.joint;
    spec.prismatic = joint.kind == "prismatic";
    spec.label = joint.label.empty() ? algorithm::short_name(terms.text(joint.joint)) : joint.label;
    context.make(spec);
  }
  BlockSpec whole = common;
  whole.slot = matrix.matrix;
  whole.quantity = matrix.matrix_quantity;
  whole.size = matrix.rows * columns;
  context.make(whole);
}

void compute_columns(Context& context, const ColumnsOfJoints& matrix, BlockIndex other) {
  const Id body = context.robot.root_body;
  std::vector<BlockIndex> blocks;
  bool floats = false;
  for (const RobotJoint& joint : context.robot.joints) {
    const bool block = joint.kind == "floating";
    floats |= block;
    blocks.push_back(context.block(matrix.column, joint.joint));
    context.closure(
        std::string(block ? matrix.columns_operator : matrix.column_operator) + "-" + joint.kind,
        {context.block("pose", joint.frame),
         composite_so_far(context, joint.frame, joint.successor), other, blocks.back()},
        joint.joint);
  }
  const auto count = static_cast<std::uint32_t>(blocks.size());
  blocks.push_back(context.block(matrix.matrix, body));
  if (floats)
    context.closure_with_counts(matrix.assemble_floating, std::move(blocks), {1, count - 1, 1},
                                body);
  else
    context.closure_with_counts(matrix.assemble, std::move(blocks), {count, 1}, body);
}

}  // namespace sinew::synthesis
