// The folder of compiled objects under everything that may happen to it: no half file is ever
// believed, and nothing is lost but the time to compile again.
#include "sinew/backend/jit/object_cache.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>
#include <vector>

#include "sinew/backend/jit.h"
#include "temporary_folder.h"

namespace sinew::backend {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kNobody = 65534;

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> names_in(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  return names;
}

// A process of its own; it ends with 0 where `work` gives true.
pid_t begin(const std::function<bool()>& work) {
  const pid_t child = fork();
  if (child == 0) _exit(work() ? 0 : 1);
  return child;
}

int ended(pid_t child) {
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return status;
}

TEST(ObjectCache, GivesBackOnlyWhatWasWrittenUnderTheName) {
  const std::string object =
      "\x7f"
      "ELF and what follows\nin several lines";
  const std::string file = sealed("a.o", object);
  EXPECT_EQ(unsealed("a.o", file), object);
  EXPECT_EQ(unsealed("b.o", file), "");
  EXPECT_EQ(unsealed("a.o", file + "x"), "");
  for (std::size_t size = 0; size < file.size(); ++size)
    EXPECT_EQ(unsealed("a.o", file.substr(0, size)), "") << "cut to " << size;
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    std::string turned = file;
    turned[bit / 8] = static_cast<char>(turned[bit / 8] ^ (1 << bit % 8));
    EXPECT_EQ(unsealed("a.o", turned), "") << "bit " << bit;
  }
}

// Each writer has contents of its own, so that a file of two writers would show.
TEST(ObjectCache, HoldsWholeObjectsWhileSeveralProcessesWriteAndRead) {
  const TemporaryFolder folder;
  constexpr int kProcesses = 4, kRounds = 150, kEntries = 3;
  constexpr std::size_t kBytes = 100'000;
  const auto work = [&](int process) {
    const auto is_whole = [](const std::string& object) {
      return object.size() == kBytes + static_cast<std::size_t>(object[0] - 'a') &&
             object.find_first_not_of(object[0]) == std::string::npos;
    };
    int found = 0;
    for (int round = 0; round < kRounds; ++round) {
      const fs::path entry = folder / (std::to_string((process + round) % kEntries) + ".o");
      const std::string before = read_cached(entry);
      if (!before.empty() && !is_whole(before)) return false;
      found += before.empty() ? 0 : 1;
      write_cached(entry, std::string(kBytes + static_cast<std::size_t>(process),
                                      static_cast<char>('a' + process)));
    }
    return found > kRounds / 2;
  };
  std::vector<pid_t> children;
  for (int i = 0; i < kProcesses; ++i) children.push_back(begin([&] { return work(i); }));
  for (const pid_t child : children) EXPECT_EQ(ended(child), 0);
  EXPECT_EQ(names_in(folder).size(), kEntries) << "nothing else is left behind";
}

TEST(ObjectCache, OutlivesProcessesThatAreKilledWhileTheyWrite) {
  const TemporaryFolder folder;
  const fs::path entry = folder / "a.o";
  const std::string object(3'000'000, 'x'), next = "written afterwards";
  int halves = 0, wholes = 0;
  for (int round = 0; round < 400 && (halves < 5 || wholes < 5); ++round) {
    const pid_t child = begin([&] {
      for (;;) write_cached(entry, object);
      return false;
    });
    std::this_thread::sleep_for(std::chrono::microseconds(1500 + 300 * (round % 40)));
    kill(child, SIGKILL);
    EXPECT_TRUE(WIFSIGNALED(ended(child)));
    const std::string found = read_cached(entry);
    EXPECT_TRUE(found.empty() || found == object || found == next);
    wholes += found == object ? 1 : 0;
    halves += fs::exists(folder / "a.o.part") ? 1 : 0;
    write_cached(entry, next);
    EXPECT_EQ(read_cached(entry), next) << "what is left stands in nobody's way";
    EXPECT_EQ(names_in(folder), std::vector<std::string>{"a.o"});
  }
  EXPECT_GT(halves, 0) << "else this test has shown nothing";
  EXPECT_GT(wholes, 0);
}

TEST(ObjectCache, LeavesTheFileToWhoeverIsWritingIt) {
  const TemporaryFolder folder;
  const fs::path entry = folder / "a.o";
  {
    const int other = open((folder / "a.o.part").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_EQ(flock(other, LOCK_EX), 0);
    write_cached(entry, "object");
    EXPECT_EQ(read_cached(entry), "");
    close(other);
  }
  write_cached(entry, "object");
  EXPECT_EQ(read_cached(entry), "object");
}

TEST(ObjectCache, IsNotNeeded) {
  const TemporaryFolder folder;
  // A file that may not grow is what a full disk is.
  EXPECT_EQ(ended(begin([&] {
              signal(SIGXFSZ, SIG_IGN);
              const rlimit small{1000, 1000};
              setrlimit(RLIMIT_FSIZE, &small);
              write_cached(folder / "full.o", std::string(5000, 'x'));
              return names_in(folder).empty();
            })),
            0);
  // In the place of the folder a file, in that of the file a folder.
  put(folder / "file", "");
  write_cached(folder / "file" / "a.o", "object");
  EXPECT_EQ(read_cached(folder / "file" / "a.o"), "");
  fs::create_directory(folder / "b.o");
  write_cached(folder / "b.o", "object");
  EXPECT_EQ(read_cached(folder / "b.o"), "");
  EXPECT_EQ(names_in(folder).size(), 2u) << "nothing else is left behind";
  // A folder that is only to be read, to one whom that concerns.
  write_cached(folder / "c.o", "object");
  fs::permissions(folder.path(), fs::perms(0555));
  EXPECT_EQ(ended(begin([&] {
              if (geteuid() == 0 && seteuid(kNobody) != 0) return false;
              write_cached(folder / "d.o", "object");
              return !fs::exists(folder / "d.o") && !fs::exists(folder / "d.o.part");
            })),
            0);
  EXPECT_EQ(read_cached(folder / "c.o"), "object");
  fs::permissions(folder.path(), fs::perms(0755));
}

TEST(ObjectCache, BelievesNoFileThatOthersMayHaveWritten) {
  const TemporaryFolder folder;
  const fs::path entry = folder / "a.o";
  write_cached(entry, "object");
  EXPECT_EQ(fs::status(entry).permissions(), fs::perms(0600));
  for (const int others : {0620, 0602, 0666}) {
    fs::permissions(entry, fs::perms(others));
    EXPECT_EQ(read_cached(entry), "") << std::oct << others;
  }
  fs::permissions(entry, fs::perms(0644));
  EXPECT_EQ(read_cached(entry), "object") << "others may read it";
  // What is no file at all is not waited for.
  fs::create_symlink(entry, folder / "link.o");
  EXPECT_EQ(read_cached(folder / "link.o"), "");
  ASSERT_EQ(mkfifo((folder / "pipe.o").c_str(), 0600), 0);
  EXPECT_EQ(read_cached(folder / "pipe.o"), "");
  ASSERT_EQ(mkfifo((folder / "q.o.part").c_str(), 0600), 0);
  write_cached(folder / "q.o", "object");
  // Nor what is too large to be one, which costs no memory.
  write_cached(folder / "large.o", "object");
  fs::resize_file(folder / "large.o", kLargestCachedFile + 1);
  EXPECT_EQ(read_cached(folder / "large.o"), "");
  write_cached(folder / "large.o", "object");
  EXPECT_EQ(read_cached(folder / "large.o"), "object");
}

TEST(ObjectCache, BelievesNoFileOfAnotherUser) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
  const TemporaryFolder folder;
  const fs::path entry = folder / "a.o";
  fs::permissions(folder.path(), fs::perms(0777));
  write_cached(entry, "of root");
  fs::permissions(entry, fs::perms(0644));
  const auto as_nobody = [&](const std::string& expected) {
    return ended(begin([&] { return seteuid(kNobody) == 0 && read_cached(entry) == expected; }));
  };
  EXPECT_EQ(as_nobody("of root"), 0);
  ASSERT_EQ(chown(entry.c_str(), kNobody, kNobody), 0);
  EXPECT_EQ(read_cached(entry), "");
  EXPECT_EQ(as_nobody("of root"), 0);
  ASSERT_EQ(chown(entry.c_str(), kNobody - 1, kNobody - 1), 0);
  EXPECT_EQ(as_nobody(""), 0);
}

// --- compiled code ---

// Sums of as many multiples of sines: another `count` is another program.
program::Computation sines(std::uint32_t count) {
  program::Computation computation;
  computation.inputs = 1;
  program::Ref sum = computation.dag.constant(0);
  for (std::uint32_t i = 1; i <= count; ++i)
    sum = computation.dag.add(sum, computation.dag.sin(computation.dag.multiply(
                                       computation.dag.constant(i), computation.dag.input(0))));
  computation.results.push_back(sum);
  return computation;
}

bool compiles_and_is_right(std::uint32_t count, const std::string& folder) {
  const JitFunction function = jit_compile(sines(count), {JitLevel::kFast, folder});
  const double in = 0.3;
  double out = 0, expected = 0;
  function(&in, &out);
  for (std::uint32_t i = 1; i <= count; ++i) expected += std::sin(i * in);
  return std::abs(out - expected) < 1e-12;
}

TEST(ObjectCache, IsSharedByProcessesThatCompileAtOnceAndMayBeKilled) {
  std::string why;
  if (!jit_available(&why)) GTEST_SKIP() << "no just-in-time compiler here: " << why;
  const TemporaryFolder folder;
  constexpr std::uint32_t kPrograms = 3;
  for (int round = 0; round < 6; ++round) {
    std::vector<pid_t> children;
    for (std::uint32_t i = 0; i < 4; ++i) {
      children.push_back(begin([&] {
        for (std::uint32_t n = 0; n < kPrograms; ++n)
          if (!compiles_and_is_right(1 + (i + n) % kPrograms, folder.string())) return false;
        return true;
      }));
    }
    // The last one of each round does not live to see the end.
    std::this_thread::sleep_for(std::chrono::milliseconds(4 + 4 * round));
    kill(children.back(), SIGKILL);
    ended(children.back());
    children.pop_back();
    for (const pid_t child : children) EXPECT_EQ(ended(child), 0);
    if (round % 2 == 0) continue;
    for (const auto& entry : fs::directory_iterator(folder.path())) fs::remove(entry.path());
  }
  for (std::uint32_t count = 1; count <= kPrograms; ++count) {
    EXPECT_TRUE(compiles_and_is_right(count, folder.string()));
    EXPECT_TRUE(jit_compile(sines(count), {JitLevel::kFast, folder.string()}).from_cache());
  }
}

}  // namespace
}  // namespace sinew::backend
