// One item of the syntax tree to declarations. Internal to the module.
#pragma once

#include <functional>

#include "sinew/blocks/syntax.h"
#include "sinew/data/declarations.h"

namespace sinew::blocks {

class ItemElaborator {
 public:
  // Gives the full name that a reference of this kind means here.
  using Resolver = std::function<std::string(const std::string& kind, const std::string& name)>;

  ItemElaborator(data::Declarations& declarations, Report& report, Resolver resolver,
                 std::string scope)
      : declarations_(declarations),
        report_(report),
        resolve_(std::move(resolver)),
        scope_(std::move(scope)) {}
  void run(const Node& node);

 private:
  void domain(const Node& node);
  void formula(const Node& node, data::DomainDeclaration& domain);
  void prototype(const Node& node);
  void view(const Node& node);
  void function(const Node& node);
  void conversion(const Node& node);
  void relation(const Node& node);
  static data::RelationRuleDeclaration rule(const Node& node);
  static data::ChangeDeclaration change(const Node& node);
  data::UnitsDeclaration units(const Node& node, const std::string& name);
  std::vector<data::MapEntry> entries(const Node& node);
  data::Algebraic form(const Node& node);
  double number(const Node& node, std::string_view name);
  std::string full(const std::string& name) const {
    return scope_.empty() ? name : scope_ + "." + name;
  }
  void error(const Place& place, std::string about, std::string what, std::string remedy);

  data::Declarations& declarations_;
  Report& report_;
  Resolver resolve_;
  std::string scope_;
};

}  // namespace sinew::blocks
