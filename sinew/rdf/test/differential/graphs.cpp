#include <fmt/format.h>

#include <set>

#include "cases.h"

namespace sinew::rdf::differential {
namespace {

constexpr const char* kLinks[] = {"p", "q", "r"};
constexpr const char* kClasses[] = {"C", "D"};
constexpr const char* kTypes[] = {"integer", "integer", "decimal", "double", "boolean", "string"};

std::string iri(const std::string& name) { return fmt::format("<http://example.org/{}>", name); }

class GraphMaker {
 public:
  explicit GraphMaker(int number)
      : random_(static_cast<std::uint64_t>(1000 + number)),
        nodes_(6 + 7 * number),
        blanks_(number % 3),
        named_graphs_(number % 4) {}

  std::string make() {
    for (int i = 0; i < nodes_ + blanks_; ++i) {
      const std::string self = node(i);
      for (const char* link : kLinks) {
        while (random_.chance(60)) add(self, iri(link), node(random_.below(nodes_ + blanks_)));
      }
      if (random_.chance(60)) add(self, kType, iri(random_.pick(kClasses)));
      if (random_.chance(70)) add(self, iri("name"), name());
      while (random_.chance(40)) add(self, iri("value"), value());
    }
    return text_;
  }

 private:
  std::string node(int i) const {
    return i < nodes_ ? iri(fmt::format("n{}", i)) : fmt::format("_:b{}", i - nodes_);
  }

  std::string name() {
    constexpr const char* kNames[] = {"arm", "Arm", "leg", "wrist joint", "", "größe", "1"};
    constexpr const char* kLanguages[] = {"", "", "@en", "@de"};
    const char* language = random_.pick(kLanguages);
    return fmt::format("\"{}\"{}", random_.pick(kNames), language);
  }

  // In the form that oxigraph gives them, which stores numbers by value and forgets how they were
  // written.
  std::string value() {
    const std::string type = random_.pick(kTypes);
    std::string text = std::to_string(random_.below(9) - 3);
    if (type == "decimal") text += random_.chance(50) ? ".5" : ".25";
    if (type == "double" && random_.chance(50)) text += ".5";
    if (type == "boolean") text = random_.chance(50) ? "true" : "false";
    if (type == "integer" && random_.chance(5)) text = "many";  // no integer
    return fmt::format("\"{}\"^^<http://www.w3.org/2001/XMLSchema#{}>", text, type);
  }

  void add(const std::string& subject, const std::string& predicate, const std::string& object) {
    const std::string triple = subject + " " + predicate + " " + object;
    if (!triples_.insert(triple).second) return;
    text_ += triple;
    const int graph = random_.below(named_graphs_ + 1);
    if (graph > 0) text_ += " " + iri(fmt::format("g{}", graph));
    text_ += " .\n";
  }

  static constexpr const char* kType = "<http://www.w3.org/1999/02/22-rdf-syntax-ns#type>";
  Random random_;
  int nodes_, blanks_, named_graphs_;
  std::set<std::string> triples_;
  std::string text_;
};

}  // namespace

std::string make_graph(int number) { return GraphMaker(number).make(); }

}  // namespace sinew::rdf::differential
