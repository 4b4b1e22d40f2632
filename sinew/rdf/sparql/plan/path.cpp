#include "sinew/rdf/sparql/plan/path.h"

#include <algorithm>

namespace sinew::rdf::sparql::plan {
namespace {

using Kind = syntax::Path::Kind;

// Gives sets of visited nodes to the sequences that are walked again and again by the closure that
// this is a part of.
void add_middles(std::uint32_t index, PathSteps& into) {
  PathStep& step = into.steps[index];
  if (step.kind != Kind::kSequence && step.kind != Kind::kAlternative) return;
  if (step.kind == Kind::kSequence) {
    step.each_middle_once = true;
    step.visited = into.visited_count;
    into.visited_count += step.part_count - 1;
  }
  for (std::uint32_t i = 0; i < step.part_count; ++i) {
    add_middles(into.parts[step.first_part + i], into);
  }
}

bool is_chain(const PathStep& step, const PathSteps& in) {
  if (step.kind == Kind::kIri) return true;
  if (step.kind != Kind::kSequence || step.part_count > kMaxChain) return false;
  return std::all_of(in.parts.begin() + step.first_part,
                     in.parts.begin() + step.first_part + step.part_count,
                     [&](std::uint32_t part) { return in.steps[part].kind == Kind::kIri; });
}

std::uint32_t compile(const syntax::Path& path, bool inverse, PathSteps& into) {
  if (path.kind == Kind::kInverse) return compile(path.parts[0], !inverse, into);
  std::vector<std::uint32_t> parts;
  for (const syntax::Path& part : path.parts) parts.push_back(compile(part, inverse, into));
  // (a/b) backward is (^b/^a).
  if (inverse && path.kind == Kind::kSequence) std::reverse(parts.begin(), parts.end());

  PathStep step;
  step.kind = path.kind;
  step.inverse = inverse;
  step.iri = path.iri;
  step.first_part = static_cast<std::uint32_t>(into.parts.size());
  step.part_count = static_cast<std::uint32_t>(parts.size());
  into.parts.insert(into.parts.end(), parts.begin(), parts.end());
  const auto zero = [&](std::uint32_t part) { return into.steps[part].matches_zero; };
  switch (path.kind) {
    case Kind::kSequence:
      step.matches_zero = std::all_of(parts.begin(), parts.end(), zero);
      break;
    case Kind::kAlternative:
      step.matches_zero = std::any_of(parts.begin(), parts.end(), zero);
      break;
    case Kind::kZeroOrMore:
    case Kind::kZeroOrOne:
    case Kind::kOneOrMore:
      step.matches_zero = path.kind != Kind::kOneOrMore || zero(parts[0]);
      step.visited = into.visited_count++;
      step.first_middle = into.visited_count;
      add_middles(parts[0], into);
      step.middle_count = into.visited_count - step.first_middle;
      if (path.kind != Kind::kZeroOrOne && is_chain(into.steps[parts[0]], into)) {
        step.chain = into.chain_count++;
      }
      break;
    case Kind::kNegated:
      step.forward = inverse ? path.backward : path.forward;
      step.backward = inverse ? path.forward : path.backward;
      step.walks_forward = inverse ? path.walks_backward : path.walks_forward;
      step.walks_backward = inverse ? path.walks_forward : path.walks_backward;
      break;
    case Kind::kIri:
    case Kind::kInverse:
      break;
  }
  into.steps.push_back(std::move(step));
  return static_cast<std::uint32_t>(into.steps.size() - 1);
}

}  // namespace

std::span<const std::uint32_t> chain_of(const PathStep& closure, const PathSteps& in) {
  const std::uint32_t* const only = &in.parts[closure.first_part];
  const PathStep& inner = in.steps[*only];
  if (inner.kind == Kind::kIri) return {only, 1};
  return {&in.parts[inner.first_part], inner.part_count};
}

PathRoots compile_path(const syntax::Path& path, PathSteps& into) {
  PathRoots roots;
  roots.forward = compile(path, false, into);
  roots.backward = compile(path, true, into);
  roots.starts = into.visited_count++;
  return roots;
}

}  // namespace sinew::rdf::sparql::plan
