// Names of items and their IRIs. Internal to the module.
#pragma once

#include <map>
#include <set>
#include <string>

#include "sinew/blocks/syntax.h"

namespace sinew::blocks {

inline constexpr std::string_view kPreludeBase = "https://w3id.org/sinew/prelude/";

// "a.b" and "c" to "a.b.c"; the scope around "a.b".
std::string join_scope(const std::string& scope, const std::string& name);
std::string outer_scope(const std::string& scope);

// The items of a file by kind and full name.
class ItemNames {
 public:
  void add(const std::string& kind, const std::string& full) { names_[kind].insert(full); }
  void collect(const Node& parent, const std::string& scope);
  bool has(const std::string& kind, const std::string& full) const;
  // The innermost item that a reference means; empty when the file has none.
  std::string resolve(const std::string& kind, const std::string& name,
                      const std::string& scope) const;
  // The shortest name that means the item here.
  std::string shorten(const std::string& kind, const std::string& full,
                      const std::string& scope) const;

 private:
  std::map<std::string, std::set<std::string>> names_;
};

}  // namespace sinew::blocks
