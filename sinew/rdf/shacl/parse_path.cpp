// Property paths (section 2.3.1).
#include <fmt/format.h>

#include "sinew/rdf/shacl/shape_parser.h"

namespace sinew::rdf::shacl {

std::optional<Path> ShapeParser::path(Id node, Id shape, std::size_t depth) {
  if (depth > kMaxPathDepth) {
    fault(shape, v_.path,
          fmt::format("the path is nested deeper than {}, or in itself", kMaxPathDepth),
          "make it shallower");
    return std::nullopt;
  }
  if (terms().is_iri(node)) return Path::of(node);
  if (terms().is_blank(node)) {
    // What the node is, by the property that it has; the first one counts where there are several.
    struct Form {
      Id property;
      Path::Kind kind;
    };
    const Form forms[] = {{v_.rdf_rest, Path::Kind::kSequence},
                          {v_.alternative_path, Path::Kind::kAlternative},
                          {v_.inverse_path, Path::Kind::kInverse},
                          {v_.zero_or_more_path, Path::Kind::kZeroOrMore},
                          {v_.one_or_more_path, Path::Kind::kOneOrMore},
                          {v_.zero_or_one_path, Path::Kind::kZeroOrOne}};
    const Form* found = nullptr;
    Id value;
    for (const Form& form : forms) {
      const auto values = in_.objects(node, form.property);
      if (values.empty()) continue;
      if (found || values.size() > 1) {
        warn(shape, v_.path, "the path can be read in several ways",
             fmt::format("it is read by its {}; remove the others",
                         name(found ? found->property : form.property)));
        if (found) continue;
      }
      found = &form;
      value = values[0];
    }
    if (found) {
      switch (found->kind) {
        case Path::Kind::kSequence:
          return several(found->kind, node, shape, depth);
        case Path::Kind::kAlternative:
          return several(found->kind, value, shape, depth);
        default:
          return wrapped(found->kind, value, shape, depth);
      }
    }
  }
  fault(shape, v_.path, fmt::format("{} is no path", name(node)),
        "a path is an IRI, a list of paths, or a blank node with one of sh:inversePath, "
        "sh:alternativePath, sh:zeroOrMorePath, sh:oneOrMorePath, sh:zeroOrOnePath");
  return std::nullopt;
}

std::optional<Path> ShapeParser::wrapped(Path::Kind kind, Id node, Id shape, std::size_t depth) {
  auto part = path(node, shape, depth + 1);
  if (!part) return std::nullopt;
  Path whole{kind, {}, {}};
  whole.parts.push_back(std::move(*part));
  return whole;
}

std::optional<Path> ShapeParser::several(Path::Kind kind, Id head, Id shape, std::size_t depth) {
  const auto members = list(shape, v_.path, head);
  if (!members) return std::nullopt;
  if (members->size() < 2) {
    fault(shape, v_.path,
          fmt::format("a list of {} path is no sequence or choice", members->size()),
          "give two paths at least");
    return std::nullopt;
  }
  Path whole{kind, {}, {}};
  for (const Id member : *members) {
    auto part = path(member, shape, depth + 1);
    if (!part) return std::nullopt;
    whole.parts.push_back(std::move(*part));
  }
  return whole;
}

}  // namespace sinew::rdf::shacl
