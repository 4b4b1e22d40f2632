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
    touch("n");
  }
  const bool has_out = std::find(arrays_.begin(), arrays_.end(), "out") != arrays_.end();
  if (has_out) {
    parameters += fmt::format(", {} *{}_RESTRICT out", scalar_, upper_);
    arguments += ", out";
  }
  for (const std::string& array : arrays_) touch(array);
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
  const fmt::format_int digits(slot);
  const std::string_view index(digits.data(), digits.size());
  const std::string& name = names_[node];
  if (block_form_) {
    block_->add(
        {"  memcpy(kept + ", index, " * ", upper_, "_LANES, &", name, ", sizeof ", name, ");"});
  } else {
    block_->add({"  kept[", index, "] = ", name, ";"});
  }
}

void FlatEmitter::read_kept(std::uint32_t node) {
  const fmt::format_int digits(parts_.slot[node]);
  const std::string_view index(digits.data(), digits.size());
  std::string& name = names_[node];
  name = given_.unique(std::string("k").append(index));
  if (block_form_) {
    block_->add({"  ", type_, " ", name, "; memcpy(&", name, ", kept + ", index, " * ", upper_,
                 "_LANES, sizeof ", name, ");"});
  } else {
    block_->add({"  const ", scalar_, " ", name, " = kept[", index, "];"});
  }
}

}  // namespace sinew::backend
