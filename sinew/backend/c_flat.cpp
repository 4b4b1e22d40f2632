// The flat style: the whole program as straight-line code on numbers.
#include "sinew/backend/c_flat_body.h"
#include "sinew/backend/c_flat_limbs.h"
#include "sinew/backend/c_flat_plan.h"
#include "sinew/backend/c_parts.h"
#include "sinew/backend/numbers.h"

namespace sinew::backend {
namespace {

// Sines of more angles than this are computed in a loop.
constexpr std::size_t kAnglesUnrolled = 16;

// Everything that is defined once for each kind of processor.
FieldList renamed(const std::string& name, std::initializer_list<const FlatBody*> bodies,
                  const LimbBody& limbs) {
  std::vector<std::string> shorts = {"lanes",        "angles", "floats",  "bits",
                                     "sincos",       "far",    "any_far", "sincos_all",
                                     "sincos_table", "sample", "block",   "update_numbers"};
  for (const FlatBody* body : bodies) {
    shorts.insert(shorts.end(), body->part_names.begin(), body->part_names.end());
  }
  shorts.insert(shorts.end(), limbs.part_names.begin(), limbs.part_names.end());
  for (const unsigned width : limbs.widths) shorts.push_back("limbs" + std::to_string(width));
  const std::string prefix = name + "_";
  FieldList list;
  for (const std::string& text : shorts) {
    Fields item;
    item.text("identifier", prefix + text);
    item.text("short", text);
    list.push_back(std::move(item));
  }
  return list;
}

using Blocks = std::vector<std::pair<std::string, const CodeBlock*>>;

}  // namespace

RenderedSource flat_source(const program::ScalarProgram& scalar,
                           const program::Interface& interface,
                           const std::vector<std::string>& identifiers, const Fields& common,
                           const COptions& options, const program::LimbProgram* limbs) {
  Fields fields = common;
  const std::string name = options.name;
  fields.text("NAME", upper_case(name));
  const bool is_float = options.scalar == Scalar::kFloat;
  fields.section("float", is_float);
  fields.section("sleef", options.trigonometry == Trigonometry::kSleef);
  fields.text("f", is_float ? "f" : "");
  // 32 and 64 bytes.
  fields.number("lanes_256", is_float ? 8 : 4);
  fields.number("lanes_512", is_float ? 16 : 8);

  const FlatLayout layout =
      evaluation_layout(scalar.program, interface, identifiers, scalar.computation);
  FlatOptions flat{name, FlatForm::kSample, options.scalar, "sample", options.maximum_statements};
  const bool cuda = options.language == Language::kCuda;
  const FlatPlan plan =
      plan_flat(scalar.computation, layout, cuda ? FlatForm::kThread : FlatForm::kSample,
                flat.maximum_statements);
  const auto body = [&](FlatForm form) {
    flat.form = form;
    return flat_body(scalar.computation, layout, flat, plan);
  };
  const bool held = !scalar.update.results.empty();
  FlatBody update;
  if (held) {
    FlatOptions of_update = flat;
    of_update.of = "update";
    of_update.form = cuda ? FlatForm::kThread : FlatForm::kSample;
    const FlatLayout of_held = update_layout(scalar.program, interface, identifiers, scalar.update);
    update =
        flat_body(scalar.update, of_held, of_update,
                  plan_flat(scalar.update, of_held, of_update.form, of_update.maximum_statements));
  }
  const auto with_update = [&](Blocks blocks, std::size_t at) {
    if (!held) return blocks;
    blocks.insert(blocks.begin() + static_cast<std::ptrdiff_t>(at),
                  {{"update_parts", &update.parts}, {"update_body", &update.code}});
    return blocks;
  };
  if (cuda) {
    const FlatBody thread = body(FlatForm::kThread);
    return render_with_blocks("c/flat.cu.mustache", std::move(fields),
                              with_update({{"parts", &thread.parts}, {"body", &thread.code}}, 1));
  }
  const FlatBody sample = body(FlatForm::kSample);
  const FlatBody block = body(FlatForm::kBlock);
  const bool has_limbs = limbs != nullptr;
  LimbBody side_by_side;
  if (has_limbs) side_by_side = limb_body(*limbs, layout, flat);
  fields.section("limbs", has_limbs);
  FieldList limb_types;
  for (const unsigned width : side_by_side.widths) {
    Fields type;
    type.number("width", width);
    limb_types.push_back(std::move(type));
  }
  fields.list("limb_types", std::move(limb_types));
  fields.list("renamed", renamed(name, {&sample, &block, &update}, side_by_side));
  fields.section("has_angles", sample.angles + update.angles > 0);
  if (sample.angles + update.angles > 0) {
    const std::size_t together = has_limbs ? side_by_side.angles : sample.angles;
    fields.section("many_angles", together > kAnglesUnrolled);
    fields.text("sincos", render("c/sincos.c.mustache", fields));
  }
  Blocks blocks = {{"parts", &sample.parts}, {"lanes_parts", &block.parts}};
  if (has_limbs) {
    blocks.insert(blocks.begin() + 1, {"limbs_parts", &side_by_side.parts});
    blocks.emplace_back("limbs_body", &side_by_side.code);
  }
  blocks.emplace_back("body", &sample.code);
  blocks.emplace_back("lanes_body", &block.code);
  return render_with_blocks("c/flat.c.mustache", std::move(fields),
                            with_update(std::move(blocks), has_limbs ? 3 : 2));
}

}  // namespace sinew::backend
