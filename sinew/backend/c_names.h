// The names of the values in a generated function: none is given twice. Internal to `backend`.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace sinew::backend {

class CNames {
 public:
  CNames(std::initializer_list<std::string> taken) : taken_(taken) {}

  // `base`, or with a number behind it where it is taken.
  std::string unique(const std::string& base);
  void take(std::string name) { taken_.insert(std::move(name)); }
  // "t1", "t2", ...: thousands of them, which need not be looked up as long as no other name is
  // like them.
  std::string temporary();

 private:
  bool is_temporary(std::string_view name) const;

  std::unordered_set<std::string> taken_;         // without temporaries
  std::unordered_map<std::string, int> numbers_;  // behind each base: those below are taken
  std::size_t temporaries_ = 0;
  bool others_like_them_ = false;
};

}  // namespace sinew::backend
