// Random queries over a tiny vocabulary, so that patterns often match: predicates :p :q :r, nodes
// :a :b :c, numbers, graphs :g :h, variables ?u ?v ?w ?x.
#pragma once

#include <random>
#include <string>

namespace sinew::rdf::sparql {

class RandomQuery {
 public:
  explicit RandomQuery(unsigned seed) : random_(seed) {}
  std::string data();   // TriG
  std::string query();  // SELECT

 private:
  unsigned below(unsigned count) { return static_cast<unsigned>(random_() % count); }
  bool chance(unsigned percent) { return below(100) < percent; }
  std::string variable() { return std::string("?") + "uvwx"[below(4)]; }
  std::string fresh_variable() { return "?n" + std::to_string(names_++); }
  std::string node() { return std::string(":") + "abc"[below(3)]; }
  std::string predicate() { return std::string(":") + "pqr"[below(3)]; }
  std::string subject() { return chance(75) ? variable() : node(); }
  std::string object();
  std::string path(unsigned depth);
  std::string verb();
  std::string triple() { return subject() + " " + verb() + " " + object() + " ."; }
  std::string expression(unsigned depth);
  std::string group(unsigned depth);
  std::string element(unsigned depth);
  std::string values();
  std::string sub_select(unsigned depth);

  std::mt19937 random_;
  unsigned names_ = 0;
  bool in_exists_ = false;
};

}  // namespace sinew::rdf::sparql
