#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinew/backend/c_constant_table.h"

namespace {

using sinew::backend::CodeBlock;
using sinew::backend::ConstantTable;
using sinew::backend::kNearNumbers;

constexpr int kNear = kNearNumbers;

struct Table {
  ConstantTable constants{"arm", "ARM", "double", "table"};
  CodeBlock code, parts;

  Table() { constants.declare_pointer(code); }
  int place(std::vector<std::string> lanes, std::size_t shared = 0) {
    return constants.place(lanes, shared);
  }
};

TEST(ConstantTable, EachUseHasAPlaceOfItsOwn) {
  Table table;
  EXPECT_EQ(table.place({"0.5"}), -kNear);
  EXPECT_EQ(table.place({"0.5"}), -kNear + 1);
}

TEST(ConstantTable, UsesNearEachOtherMayShareOne) {
  Table table;
  EXPECT_EQ(table.place({"1.0", "-1.0"}, 4), -kNear);
  EXPECT_EQ(table.place({"0.5", "0.5"}, 4), -kNear + 2);
  EXPECT_EQ(table.place({"1.0", "-1.0"}, 4), -kNear);
  EXPECT_EQ(table.place({"1.0", "-1.0"}, 2), -kNear + 4);
}

TEST(ConstantTable, AVectorBeginsAtAMultipleOfItsLanes) {
  Table table;
  table.place({"0.5"});
  EXPECT_EQ(table.place({"1.0", "2.0", "3.0", "4.0"}), -kNear + 4);
  table.constants.declare_table(4, table.parts);
  EXPECT_NE(table.parts.text.find("double __attribute__((aligned(4 * sizeof(double)))) arm_table[] "
                                  "= { 0.5, 0, 0, 0, 1.0, 2.0, 3.0, 4.0"),
            std::string::npos)
      << table.parts.text;
}

TEST(ConstantTable, ThePointerMovesWhereItWouldNotReach) {
  Table table;
  for (int k = 0; k < 2 * kNear; ++k) {
    table.constants.make_room(1, table.code);
    EXPECT_EQ(table.place({"0.5"}), k - kNear);
  }
  const std::string before = table.code.text;
  table.constants.make_room(1, table.code);
  EXPECT_NE(table.code.text, before);
  // Nothing is shared with what it no longer reaches.
  EXPECT_EQ(table.place({"0.5"}, 16), -kNear);
}

TEST(ConstantTable, NoPointerLeavesTheTable) {
  Table table;
  table.place({"0.5"});
  table.constants.declare_table(1, table.parts);
  std::size_t numbers = 1;
  for (const char c : table.parts.text.substr(table.parts.text.find('{'))) numbers += c == ',';
  EXPECT_GE(numbers, kNearNumbers);
}

}  // namespace
