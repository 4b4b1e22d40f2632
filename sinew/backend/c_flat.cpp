// The flat style: the whole program as straight-line code on numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sinew/backend/c_flat_body.h"
#include "sinew/backend/c_parts.h"

namespace sinew::backend {

RenderedSource flat_source(const program::Program& program, const program::Interface& interface,
                           const program::Computation& computation, const Fields& common,
                           std::size_t maximum_statements) {
  Fields fields = common;
  const std::string name = std::get<std::string>(common.values.at("name"));
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  fields.text("NAME", upper);

  const FlatBody sample =
      flat_body(program, interface, computation, name, FlatForm::kSample, maximum_statements);
  const FlatBody block =
      flat_body(program, interface, computation, name, FlatForm::kBlock, maximum_statements);
  // A part is compiled once, for the machine that the whole file is compiled for.
  fields.section("in_one", sample.parts.lines == 0);
  fields.section("has_angles", sample.angles > 0);
  if (sample.angles > 0) fields.text("sincos", render("c/sincos.c.mustache", fields));
  return render_with_blocks("c/flat.c.mustache", std::move(fields),
                            {{"parts", &sample.parts},
                             {"lanes_parts", &block.parts},
                             {"body", &sample.code},
                             {"lanes_body", &block.code}});
}

}  // namespace sinew::backend
