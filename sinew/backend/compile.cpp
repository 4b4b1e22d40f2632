#include "sinew/backend/compile.h"

#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "sinew/base/error.h"

extern char** environ;

namespace sinew::backend {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaximumMessage =
    4000;  // characters of a compiler's complaint that are shown

[[noreturn]] void fail(std::string what, std::string remedy) {
  throw Error(Problem{{}, {}, std::move(what), std::move(remedy), Severity::kError, {}});
}

// A folder of our own below the system's temporary folder, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "sinew-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      fail(fmt::format("no temporary folder: {}", std::strerror(errno)), "set TMPDIR");
    }
    path_ = pattern;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string read(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Runs a command, both its streams into `log`; the exit status, or a description of why it did not
// run.
int run(const std::vector<std::string>& command, const fs::path& log) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    fail(fmt::format("cannot run the C compiler '{}': {}", command[0], std::strerror(error)),
         "install one (gcc or clang), or evaluate with the interpreter");
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail("lost the C compiler's process", "try again");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

// Size of the machine code of a function that dlsym found.
std::size_t symbol_size(const void* function) {
  Dl_info info;
  const ElfW(Sym)* symbol = nullptr;
  if (dladdr1(function, &info, reinterpret_cast<void**>(const_cast<ElfW(Sym)**>(&symbol)),
              RTLD_DL_SYMENT) == 0 ||
      symbol == nullptr) {
    return 0;
  }
  return symbol->st_size;
}

}  // namespace

LoadedCode::LoadedCode(LoadedCode&& other) noexcept
    : library_(std::exchange(other.library_, nullptr)),
      function_(other.function_),
      batch_(other.batch_),
      code_bytes_(other.code_bytes_) {}

LoadedCode& LoadedCode::operator=(LoadedCode&& other) noexcept {
  std::swap(library_, other.library_);
  std::swap(function_, other.function_);
  std::swap(batch_, other.batch_);
  std::swap(code_bytes_, other.code_bytes_);
  return *this;
}

LoadedCode::~LoadedCode() {
  if (library_ != nullptr) dlclose(library_);
}

void* LoadedCode::find(const char* name) const { return dlsym(library_, name); }

LoadedCode compile_and_load(const GeneratedCode& code, const CompileOptions& options) {
  const TemporaryFolder folder;
  std::string source;
  for (const SourceFile& file : code.files) {
    const fs::path path = folder.path() / file.name;
    std::ofstream(path) << file.text;
    if (!fs::exists(path)) fail("cannot write " + path.string(), "is there space left?");
    if (path.extension() == ".c") source = path.string();
  }
  const std::string name = fs::path(source).stem().string();
  const std::string library = (folder.path() / (name + ".so")).string();
  const fs::path log = folder.path() / "compiler-log";

  std::vector<std::string> command = {options.compiler, "-shared", "-fPIC"};
  command.insert(command.end(), options.flags.begin(), options.flags.end());
  command.insert(command.end(), {"-o", library, source});
  command.insert(command.end(), options.libraries.begin(), options.libraries.end());
  command.emplace_back("-lm");
  if (const int status = run(command, log); status != 0) {
    fail(fmt::format("the C compiler '{}' failed with status {}:\n{}", options.compiler, status,
                     read(log).substr(0, kMaximumMessage)),
         "generated code should always compile: please report this");
  }

  LoadedCode loaded;
  loaded.library_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded.library_ == nullptr) {
    const char* reason = dlerror();
    fail(fmt::format("cannot load the compiled code: {}", reason != nullptr ? reason : "unknown"),
         "the temporary folder must allow execution; set TMPDIR to one that does");
  }
  loaded.function_ = dlsym(loaded.library_, name.c_str());
  loaded.batch_ = dlsym(loaded.library_, (name + "_batch").c_str());
  if (loaded.function_ == nullptr || loaded.batch_ == nullptr) {
    fail("the compiled code lacks '" + name + "' or its batch function", "generate it again");
  }
  loaded.code_bytes_ = symbol_size(loaded.function_);
  return loaded;
}

}  // namespace sinew::backend
