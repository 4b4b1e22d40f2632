#include "sinew/model/names.h"

#include "sinew/graph/percent_encoding.h"

namespace sinew::model {

std::string_view last_segment(std::string_view iri) {
  while (!iri.empty() && (iri.back() == '/' || iri.back() == '#')) iri.remove_suffix(1);
  const std::size_t cut = iri.find_last_of("/#");
  return cut == std::string_view::npos ? iri : iri.substr(cut + 1);
}

Match find_by_name(const graph::Terms& terms, std::string_view name,
                   const std::vector<std::vector<graph::Id>>& groups) {
  Match match;
  for (const std::vector<graph::Id>& group : groups) {
    for (const graph::Id element : group) {
      const std::string_view text = terms.text(element);
      if (text == name) return {element, {element}};
      const std::string_view own = last_segment(text);
      if (own == name || graph::percent_decoded(own) == name) match.candidates.push_back(element);
    }
    if (!match.candidates.empty()) break;
  }
  if (match.candidates.size() == 1) match.element = match.candidates.front();
  return match;
}

}  // namespace sinew::model
