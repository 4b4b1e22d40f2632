// What the standard drops in silence is a fault in a model: a key that no context defines, a type
// that leads to no IRI, a value that stands nowhere. This collects such faults, each with its place
// and with what was probably meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/rdf/jsonld/context.h"

namespace sinew::jsonld {

class ModelCheck {
 public:
  // Faults are errors in the report, or warnings if `lenient`.
  ModelCheck(Report& report, bool lenient) : report_(report), lenient_(lenient) {}

  // Looking for the node's IRI and for what was meant takes time; it is done for this many faults.
  static constexpr std::size_t kMaxDetailedFaults = 100;
  bool wants_details() const { return faults_ < kMaxDetailedFaults; }

  void undefined_key(const Context& active, const Source& source, const json::Value& key,
                     std::string node);
  // A text in a place where a term or an IRI is expected, that is neither.
  void undefined_term(const Context& active, const Source& source, const json::Value& text,
                      std::string_view role, std::string node);
  void relative_id(const Source& source, const json::Value& id, std::string node);
  void dropped_value(const Source& source, const json::Value& value, std::string node,
                     std::string what, std::string remedy);
  void dropped_quad(Place place, std::string node, std::string what, std::string remedy);

 private:
  void add(Place place, std::string node, std::string what, std::string remedy);

  std::string remedy_for(const Context& active, std::string_view text) const;

  Report& report_;
  bool lenient_;
  std::size_t faults_ = 0;
};

}  // namespace sinew::jsonld
