// The dictionary of names, and that what an edit refuses leaves frames and names as they were.
#include "sinew/world/names.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"

namespace sinew::world {
namespace {

constexpr std::uint32_t kMany = 20'000;

std::string text_of(std::uint32_t number) { return "http://example.org/" + std::to_string(number); }

TEST(Names, AreNumberedInTheOrderInWhichTheyCome) {
  Names names;
  for (std::uint32_t i = 1; i <= kMany; ++i) ASSERT_EQ(names.intern(text_of(i)).value, i);
  for (std::uint32_t i = 1; i <= kMany; ++i) {
    ASSERT_EQ(names.intern(text_of(i)).value, i);
    ASSERT_EQ(names.find(text_of(i)).value, i);
    ASSERT_EQ(names.text({i}), text_of(i));
  }
  EXPECT_FALSE(names.find("http://example.org/0"));
  EXPECT_EQ(names.text({}), "");
}

TEST(Names, MayBeLongerThanABlockOfTheirMemory) {
  Names names;
  const std::string longest(1 << 20, 'x');
  const Name name = names.intern(longest), after = names.intern("http://example.org/after");
  EXPECT_EQ(names.text(name), longest);
  EXPECT_EQ(names.text(after), "http://example.org/after");
}

TEST(Names, KeepTheTextThatWasHandedOut) {
  Names names;
  const std::string* const first = &names.text(names.intern(text_of(1)));
  for (std::uint32_t i = 2; i <= kMany; ++i) names.text(names.intern(text_of(i)));
  EXPECT_EQ(first, &names.text({1}));
  EXPECT_EQ(*first, text_of(1));
}

TEST(Names, AskedForBeforeTheTableGrewAreFoundAfterwards) {
  Names names;
  const std::uint32_t asked = names.ask_for(text_of(1));
  const Name name = names.intern(text_of(1));
  for (std::uint32_t i = 2; i <= kMany; ++i) names.intern(text_of(i));
  EXPECT_EQ(names.intern(text_of(1), asked), name);
}

TEST(Names, AreTheSameForAllThreads) {
  Names names;
  std::vector<std::vector<Name>> found(4);
  std::vector<std::thread> threads;
  for (std::vector<Name>& each : found) {
    threads.emplace_back([&names, &each] {
      for (std::uint32_t i = 1; i <= kMany / 4; ++i) {
        const std::string text = text_of(i);
        each.push_back(names.intern(text, names.ask_for(text)));
        if (names.text(each.back()) != text) each.back() = {};
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<Name>& each : found) EXPECT_EQ(each, found.front());
  for (const Name name : found.front()) ASSERT_TRUE(name);
}

TEST(Edit, LeavesFramesAsTheyWereWhenItRefusesARelation) {
  World world;
  const FrameId base = world.add_frame("http://example.org/base");
  const FrameId tool = world.add_frame("http://example.org/tool");
  Edit edit = world.edit();
  const FrameId gone = edit.add_frame("http://example.org/gone");
  edit.remove(gone);
  const auto refused = [&](const RelationSpec& spec) {
    EXPECT_THROW(edit.add_relation(spec), Error);
  };
  refused({.name = "http://example.org/r", .of = base, .with_respect_to = {7}});
  refused({.name = "http://example.org/r", .of = {7}, .with_respect_to = base});
  refused({.name = "http://example.org/r", .of = tool, .with_respect_to = gone});
  refused({.name = "http://example.org/r", .of = tool, .with_respect_to = tool});
  refused({.name = "http://example.org/r", .of = tool, .with_respect_to = {}});
  refused({.name = "http://example.org/tool", .of = tool, .with_respect_to = base});
  EXPECT_EQ(edit.state().frames.size(), 3u);
  for (Index frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(edit.state().frames[frame].first_relation, kNone);
  }
  const RelationId made =
      edit.add_relation({.name = "http://example.org/r", .of = tool, .with_respect_to = base});
  edit.commit();
  EXPECT_EQ(world.state().frames[base.index].first_relation, made.index);
  EXPECT_EQ(world.state().frames[tool.index].first_relation, made.index);
}

}  // namespace
}  // namespace sinew::world
