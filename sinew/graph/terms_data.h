// How Terms keeps its terms; private to terms*.cpp.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sinew/graph/arena.h"
#include "sinew/graph/numeric.h"
#include "sinew/graph/slot_table.h"
#include "sinew/graph/stable_array.h"
#include "sinew/graph/terms.h"
#include "sinew/graph/uuid.h"

namespace sinew::graph {

// 32 bytes a term. `text` is null while it waits to be made (fresh blank and derived nodes); the
// language tag follows the lexical form in memory.
struct TermEntry {
  const char* text;
  double number;
  std::uint32_t size;
  std::uint32_t link;  // a literal's datatype, a derived node's place in `derived`
  std::uint16_t language_size;
  TermKind kind;
  bool has_number;
};

struct DerivedEntry {
  const std::uint32_t* parts;
  std::uint32_t role;
  std::uint32_t count;
};

struct Terms::Data {
  std::uint32_t limit = kMaxTerms;
  std::atomic<std::uint32_t> size = 0;
  StableArray<TermEntry, Fill::kRaw> entries;  // by id; 0 is empty
  SlotTable by_text;                           // IRIs, labelled blank nodes, literals

  std::uint32_t derived_size = 0;
  StableArray<DerivedEntry, Fill::kRaw> derived;
  SlotTable by_parts;
  // Derived nodes whose IRI had arrived as text before: the node that has that text.
  std::unordered_map<std::uint32_t, std::uint32_t> same_as_text;

  Arena arena;  // writer only

  // Making texts on demand, from whichever thread.
  std::mutex demand;
  Arena demand_arena;
  struct NameBegin {  // of the names of derived nodes: a role, and the first part unless it is
                      // alone
    bool known = false;
    std::uint32_t role = 0, first = 0;
    bool alone = false;
    Sha1 hash;
  };
  std::array<NameBegin, 64> name_begins;
  std::string name_rest;                     // of the name that is being hashed
  std::vector<std::uint32_t> names_waiting;  // derived nodes whose parts get their texts first
  std::unordered_map<std::string_view, std::uint32_t> derived_by_text;
  std::uint32_t derived_named = 0;               // how many of `derived` are in derived_by_text
  std::atomic<std::uint32_t> prefixed_iris = 0;  // plain IRIs that start like a derived one
  std::atomic<std::uint32_t> derived_published = 0;
  StableArray<std::uint32_t, Fill::kRaw> derived_ids;  // the term of each derived entry

  std::uint32_t add(const TermEntry& entry);
  const char* copy(std::string_view text, std::string_view more = {});
  std::uint32_t find_text(std::uint32_t hash, TermKind kind, std::string_view text,
                          std::uint32_t datatype, std::string_view language,
                          std::uint32_t* at = nullptr) const;
  // With `demand` held.
  std::string_view make_text(std::uint32_t id);
  void append_to_name(std::uint32_t id, std::string& name) const;
  Uuid uuid_of(const DerivedEntry& made_of);
  std::uint32_t find_derived_text(std::string_view text);
};

// The first terms of every dictionary, in this order.
enum Builtin : std::uint32_t {
  kBuiltinNone,
  kBuiltinString,
  kBuiltinLangString,
  kBuiltinBoolean,
  kBuiltinFirstNumeric,  // the types of NumericType, from kDecimal on
};

NumericType numeric_type_of(std::uint32_t datatype);
std::uint32_t hash_text(TermKind kind, std::string_view text, std::uint32_t datatype = 0,
                        std::string_view language = {});

}  // namespace sinew::graph
