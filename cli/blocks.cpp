// sinew blocks: the block language: check, fmt, and the way into the graph and back.
#include <fmt/format.h>

#include <iostream>

#include "options.h"
#include "output.h"
#include "sinew/base/error.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/blocks/format.h"
#include "sinew/blocks/graph.h"
#include "sinew/blocks/parser.h"

namespace sinew::cli {
namespace {

bool is_jsonld(const std::string& file) {
  return file.ends_with(".jsonld") || file.ends_with(".json");
}

// Text or JSON-LD, by the file's name.
blocks::Node read_tree(const std::string& file) {
  const std::string text = read_input(file);
  return is_jsonld(file) ? blocks::from_jsonld(text, file) : blocks::parse(text, file);
}

// 0 when every file is in normal form (or was put into it).
int format_files(const std::vector<std::string>& files, bool in_place, bool check) {
  int code = kOk;
  for (const std::string& file : files) {
    const std::string before = read_input(file);
    const std::string after = blocks::format(blocks::parse(before, file));
    if (check) {
      if (after == before) continue;
      std::cerr << file << ": not in normal form; run sinew blocks fmt -i\n";
      code = kFault;
    } else if (!in_place) {
      std::cout << after;
    } else if (after != before) {
      write_output(file, after);
    }
  }
  return code;
}

}  // namespace

int run_blocks(Arguments arguments) {
  CLI::App app("The block language, in which data types and their meaning are described.",
               "sinew blocks");
  app.require_subcommand(1);
  std::vector<std::string> files, types;
  std::string file, output, base;
  bool in_place = false, check_only = false;

  auto* fmt_command = app.add_subcommand("fmt", "Put files into the normal form");
  fmt_command->add_option("FILE", files, "Files of the block language")->required();
  fmt_command->add_flag("-i,--in-place", in_place, "Rewrite the files instead of printing them");
  fmt_command->add_flag("--check", check_only,
                        "Change nothing; exit 1 when a file is not in normal form");

  auto* check =
      app.add_subcommand("check", "Check files: references, maps, layouts, units, formulas");
  check->add_option("FILE", files, "Files of the block language, or their JSON-LD")->required();
  check->add_option("--types", types, "Directories to look for .msg, .asn, .idl, .smdsd files in");

  auto* to_graph = app.add_subcommand("graph", "Write a file as JSON-LD");
  to_graph->add_option("FILE", file, "A file of the block language")->required();
  to_graph->add_option("--base", base, "The IRI that the file's items begin with");
  to_graph->add_option("-o,--output", output, "Write there instead of to standard output");

  auto* to_text = app.add_subcommand("text", "Write JSON-LD as a file of the block language");
  to_text
      ->add_option("FILE", file, "A JSON-LD file with the context https://w3id.org/sinew/data.json")
      ->required();
  to_text->add_option("-o,--output", output, "Write there instead of to standard output");
  if (const auto code = parse(app, std::move(arguments))) return *code;

  if (fmt_command->parsed()) return format_files(files, in_place, check_only);
  if (check->parsed()) {
    blocks::LoadOptions options;
    options.type_directories = types;
    for (const std::string& name : files) {
      const data::Library library = blocks::load_library(read_tree(name), options);
      for (const Problem& warning : library.warnings) std::cerr << to_string(warning) << "\n";
      std::cout << fmt::format("{}: {} prototypes, {} functions, {} conversions\n", name,
                               library.prototypes.size(), library.functions.size(),
                               library.function_edges.size());
    }
  } else if (to_graph->parsed()) {
    write_output(output, blocks::to_jsonld(read_tree(file),
                                           base.empty() ? blocks::default_base(file) : base));
  } else if (to_text->parsed()) {
    write_output(output, blocks::format(read_tree(file)));
  }
  return kOk;
}

}  // namespace sinew::cli
