// The names of the values in a generated function: none is given twice. Internal to `backend`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace sinew::backend {

class CNames {
 public:
  CNames(std::initializer_list<std::string> taken) : taken_(taken) {}

  // `base`, or with a number behind it where it is taken.
  std::string unique(const std::string& base);
  void take(std::string name) { taken_.insert(std::move(name)); }
  // "t1", "t2", ...: thousands of them, which need not be looked up as long as no other name is
  // like them; neither need "t1_2", "t1_3", ..., by which they are read again.
  std::string temporary();

 private:
  struct Like {  // "t17_3"; "t17" without a second one
    std::size_t number = 0, again = 0;
  };
  static Like like(std::string_view name);
  bool is_given(const Like& temporary) const;
  std::string again(const std::string& base, std::size_t number);

  std::unordered_set<std::string> taken_;         // without temporaries
  std::unordered_map<std::string, int> numbers_;  // behind each base: those below are taken
  std::vector<std::uint32_t> again_;              // the same behind each temporary
  std::size_t temporaries_ = 0;
  bool others_like_them_ = false;
};

}  // namespace sinew::backend
