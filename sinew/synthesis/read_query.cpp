#include "sinew/synthesis/read_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <span>
#include <utility>

#include "sinew/algorithm/names.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/model/sizes.h"
#include "sinew/rdf/jsonld/load.h"

namespace sinew::synthesis {

// solvers/*.json, written into the library by the build.
std::span<const std::pair<std::string_view, std::string_view>> embedded_solvers();

namespace {

using algorithm::short_name;
using graph::Id;

// What a query names in a word lies here until the model says which element it is.
constexpr std::string_view kNameNamespace = "https://w3id.org/sinew/name#";
constexpr std::int64_t kMostDirectionInputs = 6;

// A JSON-LD text in a graph of its own.
struct Document {
  graph::Store store;
  graph::Places places;
};

void load(std::string_view text, const std::string& file, jsonld::Loader& loader,
          Document& document) {
  Report report;
  graph::Transaction transaction = document.store.begin();
  loader.load(
      text, file, document.store.terms(), [&](const graph::Quad& quad) { transaction.add(quad); },
      &document.places, report);
  report.throw_if_errors();
  transaction.commit();
}

// Reads the properties of nodes in the query vocabulary.
class Reader {
 public:
  Reader(const graph::View& view, const graph::Places* places, Report& report)
      : view_(view), terms_(view.terms()), places_(places), report_(report) {}

  Id word(std::string_view name) const {
    return terms_.find_iri(std::string(kQueryNamespace) + std::string(name));
  }
  Id rdf(std::string_view name) const {
    return terms_.find_iri(std::string(graph::kRdf) + std::string(name));
  }

  Id only_of_type(std::string_view type, const std::string& file) {
    std::vector<Id> found;
    const Id property = rdf("type"), wanted = word(type);
    if (property && wanted)
      view_.match({}, property, wanted, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
        found.push_back(quad.subject);
        return true;
      });
    if (found.size() == 1) return found.front();
    report_.error({file, 0, 0}, "", fmt::format("{} nodes of type {}", found.size(), type),
                  fmt::format("the file holds one {}", type));
    return {};
  }

  std::vector<Id> objects(Id subject, std::string_view property) const {
    std::vector<Id> found;
    if (const Id predicate = word(property))
      view_.match(subject, predicate, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
        found.push_back(quad.object);
        return true;
      });
    return found;
  }

  std::string text(Id subject, std::string_view property) {
    const std::vector<Id> found = objects(subject, property);
    if (found.size() > 1) error(subject, property, "has two values of", "state one");
    return found.empty() ? "" : std::string(terms_.text(found.front()));
  }

  std::string required_text(Id subject, std::string_view property) {
    std::string value = text(subject, property);
    if (value.empty()) error(subject, property, "lacks", "state it");
    return value;
  }

  std::vector<Id> list(Id subject, std::string_view property) {
    const std::vector<Id> heads = objects(subject, property);
    return heads.empty() ? std::vector<Id>{} : items(subject, property, heads.front());
  }

  // The items of a list that a property of `subject` leads to.
  std::vector<Id> items(Id subject, std::string_view property, Id head) {
    std::vector<Id> items;
    const Id nil = rdf("nil"), first = rdf("first"), rest = rdf("rest");
    for (Id node = head; node && node != nil; node = view_.object(node, rest)) {
      const Id item = first ? view_.object(node, first) : Id{};
      if (!item || items.size() > kLongestList) {
        error(subject, property, "has a broken list of", "write a list");
        break;
      }
      items.push_back(item);
    }
    return items;
  }

  // An element: one of the words that stand for several or for a frame, a name, or an IRI.
  std::string element(Id subject, std::string_view property) {
    const std::string name = element_of(text(subject, property));
    if (name.empty() && !objects(subject, property).empty())
      error(subject, property, "has nothing in", "name an element, or leave it out");
    return name;
  }

  static std::string element_of(std::string name) {
    for (const std::string_view space : {kQueryNamespace, kNameNamespace})
      if (name.starts_with(space)) return name.substr(space.size());
    return name;
  }

  // One of two words; the first when nothing is stated.
  bool is_second(Id subject, std::string_view property, std::string_view first,
                 std::string_view second) {
    const std::string word = element(subject, property);
    if (!word.empty() && word != first && word != second)
      error(subject, property, "has an unknown value of", fmt::format("{} or {}", first, second));
    return word == second;
  }

  // Of a node, or of what it says with a property. A node without a name has a place only.
  Origin origin(Id node, std::string_view property) const {
    return {terms_.is_iri(node) ? std::string(terms_.text(node)) : std::string(),
            places_ != nullptr ? places_->find(node, word(property)) : Place{}};
  }

  // Faults of nodes without a name are the query's.
  void error(Id node, std::string_view property, std::string_view what, std::string remedy) {
    const Id named = terms_.is_blank(node) && query_ ? query_ : node;
    report_.error(places_ ? places_->find(node, word(property)) : Place{},
                  terms_.is_blank(named) ? std::string() : std::string(terms_.text(named)),
                  fmt::format("{} {}", what, property), std::move(remedy));
  }

  void reads(Id query) { query_ = query; }

  const graph::Terms& terms() const { return terms_; }

 private:
  static constexpr std::size_t kLongestList = 10'000;

  const graph::View& view_;
  const graph::Terms& terms_;
  const graph::Places* places_;
  Report& report_;
  Id query_;
};

void read_gravity(Reader& reader, Id node, Query& query) {
  const std::vector<Id> numbers = reader.list(node, "gravity");
  if (numbers.empty()) return;
  std::array<double, 3> vector{};
  bool fine = numbers.size() == 3;
  for (std::size_t i = 0; fine && i < 3; ++i) {
    const auto number = reader.terms().number(numbers[i]);
    fine = number && model::within(*number, model::kLargestAcceleration);
    vector[i] = number.value_or(0);
  }
  if (fine)
    query.gravity = vector;
  else
    reader.error(
        node, "gravity", "has no vector of",
        fmt::format("three numbers [m/s^2], each at most {:g}", model::kLargestAcceleration));
}

// Of six numbers.
std::array<double, 6> read_unit_force(Reader& reader, Id given, Id list) {
  std::array<double, 6> force{};
  const std::vector<Id> numbers = reader.items(given, "unit-forces", list);
  bool fine = numbers.size() == force.size();
  for (std::size_t i = 0; fine && i < force.size(); ++i) {
    const auto number = reader.terms().number(numbers[i]);
    fine = number.has_value();
    force[i] = number.value_or(0);
  }
  if (!fine)
    reader.error(given, "unit-forces", "has an entry that is no unit force in",
                 "six numbers, moment first");
  return force;
}

Given read_given(Reader& reader, Id node) {
  Given given{reader.required_text(node, "quantity"), reader.element(node, "of"),
              reader.element(node, "seen-by"), reader.text(node, "varies") == "true"};
  given.origin = reader.origin(node, "quantity");
  if (given.quantity != "acceleration-constraint") return given;
  if (reader.terms().is_iri(node)) given.iri = reader.terms().text(node);
  for (const Id direction : reader.list(node, "directions"))
    given.directions.emplace_back(short_name(reader.terms().text(direction)));
  for (const Id list : reader.list(node, "unit-forces"))
    given.unit_forces.push_back(read_unit_force(reader, node, list));
  if (const std::vector<Id> number = reader.objects(node, "direction-inputs"); !number.empty()) {
    const auto count = reader.terms().integer_value(number.front());
    if (number.size() > 1 || !count || *count < 1 || *count > kMostDirectionInputs)
      reader.error(node, "direction-inputs", "has no good number of", "a number from 1 to 6");
    else
      given.direction_inputs = static_cast<unsigned>(*count);
  }
  return given;
}

double read_number(Reader& reader, Id node, std::string_view property) {
  const std::vector<Id> found = reader.objects(node, property);
  const auto number = found.size() == 1 ? reader.terms().number(found.front()) : std::nullopt;
  if (!number) reader.error(node, property, "lacks", "state one number");
  return number.value_or(0);
}

void read_policies(Reader& reader, Id node, DriverPolicy& policy) {
  const auto word = [&](std::string_view property) {
    return std::string(short_name(reader.text(node, property)));
  };
  const std::string singular = word("singular"), list = word("drivers");
  if (singular == "in-order") policy.singular = Singular::kInOrder;
  if (singular == "truncated") policy.singular = Singular::kTruncated;
  if (singular == "damped") policy.singular = Singular::kDamped;
  if (policy.singular != Singular::kUnstated)
    policy.singular_number =
        read_number(reader, node, policy.singular == Singular::kDamped ? "damping" : "tolerance");
  else if (!singular.empty())
    reader.error(node, "singular", "has another word for", "in-order, damped or truncated");
  if (list == "apart") policy.list = DriverList::kApart;
  if (list == "weighed") policy.list = DriverList::kWeighed;
  if (!list.empty() && list != "together" && policy.list == DriverList::kTogether)
    reader.error(node, "drivers", "has another word for", "together, apart or weighed");
  policy.limited = reader.element(node, "limited");
  policy.singular_origin = reader.origin(node, "singular");
  policy.limited_origin = reader.origin(node, "limited");
}

SweepConfiguration read_sweeps(const graph::View& view, Id node, const graph::Places* places,
                               Report& report) {
  Reader reader(view, places, report);
  SweepConfiguration configuration;
  configuration.iri = view.terms().text(node);
  for (const Id sweep : reader.list(node, "sweep")) {
    SweepNames names;
    names.direction = short_name(reader.required_text(sweep, "direction"));
    for (const Id step : reader.list(sweep, "steps"))
      names.steps.emplace_back(short_name(view.terms().text(step)));
    configuration.sweeps.push_back(std::move(names));
  }
  return configuration;
}

std::string_view embedded(std::string_view file) {
  for (const auto& [name, text] : embedded_solvers())
    if (name == file) return text;
  return {};
}

}  // namespace

Query read_query(const graph::View& view, Id node, const graph::Places* places, Report& report) {
  Reader reader(view, places, report);
  reader.reads(node);
  Query query;
  query.iri = view.terms().text(node);
  if (places != nullptr) query.place = places->find(node, reader.word("asks"));
  query.name = reader.text(node, "name");
  if (query.name.empty()) query.name = short_name(view.terms().text(node));
  for (const Id asked : reader.list(node, "asks"))
    query.asked.push_back({reader.required_text(asked, "quantity"), reader.element(asked, "of"),
                           reader.element(asked, "seen-by"),
                           reader.element(asked, "with-respect-to"),
                           reader.origin(asked, "quantity")});
  for (const Id given : reader.objects(node, "gives"))
    query.given.push_back(read_given(reader, given));
  for (const Id held : reader.objects(node, "holds"))
    query.held.push_back({reader.required_text(held, "quantity"), reader.element(held, "of"),
                          reader.origin(held, "quantity")});
  query.base = reader.element(node, "base");
  for (const Id tip : reader.list(node, "tips"))
    query.tips.push_back(Reader::element_of(std::string(view.terms().text(tip))));
  if (!query.base.empty()) query.base_origin = reader.origin(node, "base");
  if (!query.tips.empty()) query.tips_origin = reader.origin(node, "tips");
  read_gravity(reader, node, query);
  query.floating = reader.text(node, "floating") == "true";
  query.forces =
      reader.is_second(node, "forces", "together", "apart") ? Forces::kApart : Forces::kTogether;
  query.frames = reader.is_second(node, "frames", "moving", "stationary") ? Frames::kStationary
                                                                          : Frames::kMoving;
  read_policies(reader, node, query.drivers);
  query.sweeps = reader.text(node, "sweeps");
  if (query.asked.empty())
    reader.error(node, "asks", "asks for nothing: it lacks", "list what is asked");
  return query;
}

namespace {

// Loads a document, and reads its one node of this type by `read(view, node, places, report)`.
template <typename Read>
auto parse_one(std::string_view text, const std::string& file, jsonld::Loader& loader,
               std::string_view type, Read read) {
  Document document;
  load(text, file, loader, document);
  Report report;
  const graph::View view = document.store.view();
  const Id node = Reader(view, &document.places, report).only_of_type(type, file);
  report.throw_if_errors();
  auto result = read(view, node, &document.places, report);
  report.throw_if_errors();
  return result;
}

// For what comes with Sinew: the contexts that its files share are read once.
template <typename Read>
auto parse_own(std::string_view text, const std::string& file, std::string_view type, Read read) {
  static std::mutex mutex;
  static const catalogue::Catalogue catalogue;
  static jsonld::Loader loader(catalogue);
  const std::scoped_lock lock(mutex);
  return parse_one(text, file, loader, type, read);
}

}  // namespace

Query parse_query(std::string_view text, const std::string& file,
                  const catalogue::Catalogue& catalogue) {
  jsonld::Loader loader(catalogue);
  return parse_one(text, file, loader, "Query", read_query);
}

SweepConfiguration parse_sweeps(std::string_view text, const std::string& file,
                                const catalogue::Catalogue& catalogue) {
  jsonld::Loader loader(catalogue);
  return parse_one(text, file, loader, "SweepConfiguration", read_sweeps);
}

std::vector<std::string> named_queries() {
  std::vector<std::string> names;
  for (const auto& [file, text] : embedded_solvers()) {
    const std::string_view name = file.substr(0, file.rfind('.'));
    if (name.find('/') == std::string_view::npos) names.emplace_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

Query named_query(std::string_view name) {
  const std::string file = std::string(name) + ".json";
  const std::string_view text = embedded(file);
  if (text.empty())
    throw Error(Problem{{},
                        std::string(name),
                        "there is no solver of this name",
                        fmt::format("one of {}", fmt::join(named_queries(), ", ")),
                        {},
                        {}});
  return parse_own(text, "solvers/" + file, "Query", read_query);
}

SweepConfiguration named_sweeps(std::string_view name) {
  const std::string file = "sweeps/" + std::string(short_name(name)) + ".json";
  const std::string_view text = embedded(file);
  if (text.empty())
    throw Error(Problem{{},
                        std::string(name),
                        "there is no sweep configuration of this name",
                        "one of solvers/sweeps/",
                        {},
                        {}});
  return parse_own(text, "solvers/" + file, "SweepConfiguration", read_sweeps);
}

}  // namespace sinew::synthesis
