#include "sinew/blocks/elaborate.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "sinew/base/spelling.h"
#include "sinew/blocks/elaborate_items.h"
#include "sinew/blocks/parser.h"
#include "sinew/data/embedded.h"

namespace sinew::blocks {
namespace {

constexpr const char* kPreludeFile = "blocks/geometry.blocks";
constexpr const char* kPreludeModule = "prelude";

std::string read_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw Error(Problem{
        {file, 0, 0}, {}, "the file cannot be read", "check its name", Severity::kError, {}});
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

// An item with the module that it stands in.
struct ScopedItem {
  const Node* node;
  std::string scope;  // "a.b" or empty
};

class Elaboration {
 public:
  data::Declarations run(const Node& file) {
    collect(file, "");
    for (const ScopedItem& item : items_) declare_name(item);
    collect_prelude();
    for (std::size_t i = 0; i < items_.size(); ++i) elaborate_item(items_[i]);
    // Prelude items are elaborated where a reference asks for them; they may ask for others.
    do {
      while (!wanted_.empty()) {
        const ScopedItem item = *wanted_.begin()->second;
        wanted_.erase(wanted_.begin());
        elaborate_item(item);
      }
      add_prelude_aliases();
    } while (!wanted_.empty());
    report_.throw_if_errors();
    return std::move(declarations_);
  }

 private:
  static std::string joined(const std::string& scope, const std::string& name) {
    return scope.empty() ? name : scope + "." + name;
  }

  static std::string outer(const std::string& scope) {
    const std::size_t dot = scope.rfind('.');
    return dot == std::string::npos ? "" : scope.substr(0, dot);
  }

  void collect(const Node& parent, const std::string& scope) {
    for (const Node& node : parent.children) {
      if (node.kind == "module") {
        collect(node, joined(scope, node.text("name")));
      } else if (node.kind == "import") {
        import(node, scope);
      } else {
        items_.push_back({&node, scope});
      }
    }
  }

  void import(const Node& node, const std::string& scope) {
    namespace fs = std::filesystem;
    fs::path path = node.text("file");
    if (path.is_relative()) path = fs::path(node.place.file).parent_path() / path;
    const std::string target = node.has("as") ? joined(scope, node.text("as")) : scope;
    std::error_code ignored;
    const std::string key = fs::weakly_canonical(path, ignored).string();
    if (open_imports_.count(key)) {
      report_.error(node.place, {}, fmt::format("'{}' imports itself", node.text("file")),
                    "leave the import out");
      return;
    }
    if (!imported_.insert({key, target}).second) return;
    if (imported_.size() > kMaximumImports) {
      report_.error(node.place, {}, fmt::format("more than {} files are imported", kMaximumImports),
                    "");
      return;
    }
    try {
      trees_.push_back(std::make_unique<Node>(parse(read_file(path.string()), path.string())));
    } catch (const Error& error) {
      for (Problem problem : error.problems()) {
        if (problem.place.file == path.string() && problem.place.line == 0) {
          problem.what = fmt::format("'{}' cannot be read", node.text("file"));
          problem.place = node.place;
        }
        report_.add(std::move(problem));
      }
      return;
    }
    open_imports_.insert(key);
    collect(*trees_.back(), target);
    open_imports_.erase(key);
  }

  void declare_name(const ScopedItem& item) {
    const std::string& name = item.node->text("name");
    if (!name.empty()) names_[item.node->kind].insert(joined(item.scope, name));
  }

  void collect_prelude() {
    for (const Node& node : prelude().children) {
      if (node.kind == "domain") {
        // Always there, unless the file declares its own.
        if (!names_["domain"].count(node.text("name"))) {
          prelude_domains_.push_back({&node, ""});
          names_["domain"].insert(node.text("name"));
        }
      } else {
        prelude_items_.push_back({&node, kPreludeModule});
      }
    }
    items_.insert(items_.end(), prelude_domains_.begin(), prelude_domains_.end());
  }

  // The full name that a reference means; the reference itself when nothing fits, for the check to
  // report.
  std::string resolve(const std::string& kind, const std::string& name, const std::string& scope) {
    for (std::string at = scope;; at = outer(at)) {
      const std::string full = joined(at, name);
      if (names_[kind].count(full)) return full;
      if (at.empty()) break;
    }
    const std::string prefix = std::string(kPreludeModule) + ".";
    const std::string plain = name.starts_with(prefix) ? name.substr(prefix.size()) : name;
    for (const ScopedItem& item : prelude_items_) {
      if (item.node->kind != kind || item.node->text("name") != plain) continue;
      if (prelude_used_.insert({kind, plain}).second) wanted_[{kind, plain}] = &item;
      return prefix + plain;
    }
    return name;
  }

  // The prelude's aliases of the forms that are used, which may bring in others.
  void add_prelude_aliases() {
    for (const ScopedItem& item : prelude_items_) {
      if (item.node->kind != "alias" || aliases_added_.count(item.node)) continue;
      if (prelude_used_.count({"algebraic", item.node->text("left")}) ||
          prelude_used_.count({"algebraic", item.node->text("right")})) {
        aliases_added_.insert(item.node);
        elaborate_item(item);
      }
    }
  }

  void elaborate_item(const ScopedItem& item) {
    const auto resolver = [&](const std::string& kind, const std::string& name) {
      return resolve(kind, name, item.scope);
    };
    ItemElaborator(declarations_, report_, resolver, item.scope).run(*item.node);
  }

  data::Declarations declarations_;
  Report report_;
  std::vector<ScopedItem> items_, prelude_items_, prelude_domains_;
  std::vector<std::unique_ptr<Node>> trees_;  // of imported files
  std::set<std::pair<std::string, std::string>> imported_;
  std::set<std::string> open_imports_;
  std::map<std::string, std::set<std::string>> names_;  // by kind
  std::set<std::pair<std::string, std::string>> prelude_used_;
  std::map<std::pair<std::string, std::string>, const ScopedItem*> wanted_;
  std::set<const Node*> aliases_added_;
};

}  // namespace

const Node& prelude() {
  static const Node tree =
      parse(data::embedded_file(kPreludeFile), std::string("metamodels/") + kPreludeFile);
  return tree;
}

data::Declarations elaborate(const Node& file) { return Elaboration().run(file); }

data::Library load_library(const std::string& file, const LoadOptions& options) {
  return load_library(read_file(file), file, options);
}

data::Library load_library(std::string_view text, const std::string& file,
                           const LoadOptions& options) {
  return load_library(parse(text, file), options);
}

data::Library load_library(const Node& file, const LoadOptions& options) {
  data::TypeSources sources = data::sources_beside(file.place.file);
  sources.directories.insert(sources.directories.begin(), options.type_directories.begin(),
                             options.type_directories.end());
  return data::make_library(elaborate(file), sources);
}

}  // namespace sinew::blocks
