#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sinew/backend/c_flat_emitter.h"

namespace sinew::backend {

// Keeps what the parts need of what has been computed, and calls them; their code goes to
// `parts`.
void FlatEmitter::call_parts(const std::vector<std::uint32_t>& before) {
  std::string parameters, arguments;
  for (const std::string& array : arrays_) {
    if (array == "in" || array == "out") continue;
    // Parts write to `out` only.
    parameters += fmt::format(", const {} *{}", scalar_, array);
    arguments += ", " + array;
  }
  if (strided()) {
    parameters += ", size_t n";
    arguments += ", n";
    touched_.insert("n");
  }
  const bool has_out = std::find(arrays_.begin(), arrays_.end(), "out") != arrays_.end();
  if (has_out) {
    parameters += fmt::format(", {} *{}_RESTRICT out", scalar_, upper_);
    arguments += ", out";
  }
  for (const std::string& array : arrays_) touched_.insert(array);
  line(fmt::format("{0}_ALIGNED {3} kept[{1}{2}];", upper_, parts_.slots,
                   block_form_ ? fmt::format(" * {}_LANES", upper_) : "", scalar_));
  for (const std::uint32_t node : before) keep(node);
  for (std::size_t k = 0; k < parts_.parts.size(); ++k) {
    result_.part_names.push_back(
        fmt::format("{}{}_part{}", options_.of, block_form_ ? "_block" : "", k + 1));
    const std::string function = prefix_ + "_" + result_.part_names.back();
    line(fmt::format("{}(in, kept{});", function, arguments));
    block_ = &result_.parts;
    const bool zero_outside = std::exchange(zero_, false);
    forget();
    block_->add(fmt::format("{0}_APART void {1}(const {3} *in, {3} *kept{2}) {{", upper_, function,
                            parameters, scalar_));
    for (const std::uint32_t node : parts_.parts[k]) {
      emit(node);
      keep(node);
    }
    line("(void)in;");
    for (const std::string& array : arrays_) {
      if (array != "in") line(fmt::format("(void){};", array));
    }
    if (strided()) line("(void)n;");
    block_->add("}");
    block_->add("");
    block_ = &result_.code;
    zero_ = zero_outside;
  }
  forget();
}

// Values that another function has computed are read from where they are kept.
void FlatEmitter::forget() {
  for (std::string& name : names_) name.clear();
}

void FlatEmitter::keep(std::uint32_t node) {
  const std::uint32_t slot = parts_.slot[node];
  if (slot == FlatParts::kNoSlot) return;
  if (block_form_) {
    line(fmt::format("memcpy(kept + {0} * {1}_LANES, &{2}, sizeof {2});", slot, upper_,
                     names_[node]));
  } else {
    const fmt::format_int index(slot);
    block_->add({"  kept[", {index.data(), index.size()}, "] = ", names_[node], ";"});
  }
}

void FlatEmitter::read_kept(std::uint32_t node) {
  names_[node] = given_.unique(fmt::format("k{}", parts_.slot[node]));
  if (block_form_) {
    line(fmt::format("{0} {1}; memcpy(&{1}, kept + {2} * {3}_LANES, sizeof {1});", type_,
                     names_[node], parts_.slot[node], upper_));
  } else {
    line(fmt::format("const {} {} = kept[{}];", scalar_, names_[node], parts_.slot[node]));
  }
}

}  // namespace sinew::backend
