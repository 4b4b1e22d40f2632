#include "sinew/blocks/format.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/blocks/schema.h"

namespace sinew::blocks {
namespace {

bool is_plain_name(const std::string& text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text[0]))) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool alnum = std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_';
    const bool hyphen = text[i] == '-' && i > 0 && i + 1 < text.size() && text[i + 1] != '-';
    if (!alnum && !hyphen) return false;
  }
  return text[0] != '-';
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

class Formatter {
 public:
  std::string run(const Node& file) {
    items(file, "");
    return std::move(text_);
  }

 private:
  // ---- one line of each kind of entry ----

  static std::string entry(const Node& node) {
    const std::string& kind = node.kind;
    if (kind == "entry") {
      if (node.has("constant"))
        return fmt::format("{} = const {}", node.text("left"), node.text("constant"));
      return fmt::format("{} = {}{}", node.text("left"), node.text("sign"), node.text("right"));
    }
    if (kind == "unit")
      return fmt::format("{} = {}", unit(node.text("unit")), node.text("accessor"));
    if (kind == "member") return fmt::format("{} = {}", node.text("name"), node.text("value"));
    if (kind == "parameter") {
      if (node.has("constant"))
        return fmt::format("{} = const {}", node.text("name"), node.text("constant"));
      return fmt::format("{} = {}", node.text("name"), unit(node.text("unit")));
    }
    if (kind == "setting") {
      const std::string value = node.has("text")     ? fmt::format("\"{}\"", node.text("text"))
                                : node.has("number") ? node.text("number")
                                                     : node.text("word");
      return fmt::format("{} = {}", node.text("name"), value);
    }
    if (kind == "argument") {
      return fmt::format("{} {} {}", node.text("position"), node.text("direction"),
                         node.text("prototype"));
    }
    if (kind == "annotation") {
      return node.text("name") + (node.has("optional") ? " ?" : "");
    }
    if (kind == "composite") {
      return fmt::format("composite {} = {{ {} }}", node.text("name"),
                         fmt::join(node.all("member"), ", "));
    }
    return fmt::format("older {}", node.text("name"));
  }

  static std::string unit(const std::string& text) {
    return is_plain_name(text) ? text : fmt::format("\"{}\"", text);
  }

  static bool has_words(const std::vector<std::string>& lines) {
    return std::any_of(lines.begin(), lines.end(),
                       [](const std::string& line) { return !line.empty(); });
  }
  static bool commented(const Node& node) {
    return has_words(node.comments) || !node.remark.empty();
  }

  // Blank lines between comments stay where `blanks`; those before the first one are the caller's.
  void comments(const std::vector<std::string>& lines, const std::string& indent,
                bool blanks = false) {
    bool first = true;
    for (const std::string& line : lines) {
      if (line.empty()) {
        if (blanks && !first) text_ += "\n";
        continue;
      }
      text_ += indent + line + "\n";
      first = false;
    }
  }
  void end_comments(std::vector<std::string> lines, const std::string& indent) {
    while (!lines.empty() && lines.back().empty()) lines.pop_back();
    comments(lines, indent, true);
  }
  static bool blank_before(const Node& node) {
    return !node.comments.empty() && node.comments.front().empty();
  }

  void remark(const Node& node) {
    if (!node.remark.empty()) text_ += " " + node.remark;
  }

  // "head { a = b, c = d }" on one line if it fits, else filled lines, else, with comments, one
  // entry a line.
  void braces(const std::string& head, const Node& node, const std::string& indent) {
    const bool plain = !has_words(node.end_comments) &&
                       std::none_of(node.children.begin(), node.children.end(), commented);
    std::string line = indent + head + " {";
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      line += (i > 0 ? ", " : " ") + entry(node.children[i]);
    }
    line += node.children.empty() ? "}" : " }";
    if (plain && line.size() <= kLineWidth) {
      text_ += line;
      return;
    }
    text_ += indent + head + " {\n";
    const std::string inner = indent + "  ";
    if (plain) {
      line = inner;
      for (std::size_t i = 0; i < node.children.size(); ++i) {
        const std::string part =
            entry(node.children[i]) + (i + 1 < node.children.size() ? "," : "");
        if (line != inner && line.size() + 1 + part.size() > kLineWidth) {
          text_ += line + "\n";
          line = inner;
        }
        line += (line == inner ? "" : " ") + part;
      }
      if (line != inner) text_ += line + "\n";
    } else {
      for (const Node& child : node.children) {
        comments(child.comments, inner);
        text_ += inner + entry(child);
        remark(child);
        text_ += "\n";
      }
      comments(node.end_comments, inner);
    }
    text_ += indent + "}";
  }

  // A type or formula: on one line if it is one, else each of its lines indented alike.
  void raw(const std::string& head, const std::string& content, const std::string& indent) {
    const std::string body = trimmed(content);
    const std::string line = body.empty() ? fmt::format("{}{} {{}}", indent, head)
                                          : fmt::format("{}{} {{ {} }}", indent, head, body);
    const bool one_line =
        body.find('\n') == std::string::npos && body.find("//") == std::string::npos;
    if (one_line && line.size() <= kLineWidth) {
      text_ += line;
      return;
    }
    text_ += indent + head + " {\n";
    std::size_t shared = std::string::npos;  // the least indentation of the lines after the first
    for_each_line(body, [&](std::string_view line, bool first) {
      const std::size_t blank = line.find_first_not_of(" \t\r");
      if (!first && blank != std::string_view::npos) shared = std::min(shared, blank);
    });
    // The first line lost its indentation when the text was trimmed; it was like that of the
    // others.
    for_each_line(body, [&](std::string_view line, bool first) {
      if (!first) line = line.substr(std::min({line.size(), shared}));
      std::string kept(line);
      while (!kept.empty() && (kept.back() == ' ' || kept.back() == '\r' || kept.back() == '\t'))
        kept.pop_back();
      text_ += kept.empty() ? "\n" : indent + "  " + kept + "\n";
    });
    text_ += indent + "}";
  }

  template <typename Visit>
  static void for_each_line(std::string_view text, Visit&& visit) {
    bool first = true;
    while (true) {
      const std::size_t end = text.find('\n');
      visit(text.substr(0, end), first);
      if (end == std::string_view::npos) return;
      text.remove_prefix(end + 1);
      first = false;
    }
  }

  // ---- items ----

  void items(const Node& parent, const std::string& indent) {
    for (std::size_t i = 0; i < parent.children.size(); ++i) {
      const Node& node = parent.children[i];
      const std::size_t before = text_.size();
      comments(node.comments, indent, true);
      const auto begin = static_cast<std::ptrdiff_t>(text_.size());
      item(node, indent);
      remark(node);
      text_ += "\n";
      // Short items of one kind may stay together; everything else is set off by a blank line.
      const auto lines = std::count(text_.begin() + begin, text_.end(), '\n');
      if (i > 0 && (blank_before(node) || has_words(node.comments) || lines > 1 ||
                    last_lines_ > 1 || node.kind != parent.children[i - 1].kind)) {
        text_.insert(before, "\n");
      }
      last_lines_ = lines;
    }
    if (has_words(parent.end_comments)) {
      if (!parent.children.empty()) text_ += "\n";
      end_comments(parent.end_comments, indent);
    }
  }

  void item(const Node& node, const std::string& indent) {
    const std::string& kind = node.kind;
    if (kind == "import") {
      text_ += fmt::format("{}import \"{}\"", indent, node.text("file"));
      if (node.has("as")) text_ += " as " + node.text("as");
    } else if (kind == "module") {
      text_ += fmt::format("{}module {} {{\n", indent, node.text("name"));
      items(node, indent + "  ");
      text_ += indent + "}";
      last_lines_ = 2;
    } else if (kind == "domain") {
      domain(node, indent);
    } else if (kind == "ddr") {
      raw(fmt::format("ddr {} :: {}", node.text("name"), node.text("context")), node.text("text"),
          indent);
    } else if (kind == "algebraic") {
      text_ +=
          fmt::format("{}algebraic {} :: {}", indent, node.text("name"), form(node.text("form")));
    } else if (kind == "units") {
      braces(fmt::format("units {} :: {}, {}", node.text("name"), node.text("ontology"),
                         node.text("algebraic")),
             node, indent);
    } else if (kind == "alias") {
      braces(fmt::format("alias {} <-> {}", node.text("left"), node.text("right")), node, indent);
    } else if (kind == "dproto") {
      prototype(node, indent);
    } else if (kind == "view") {
      const std::string head = fmt::format("view {}.{} -> {}", node.text("prototype"),
                                           node.text("member"), node.text("target"));
      if (node.has("function")) {
        text_ += fmt::format("{}{} = {}", indent, head, node.text("function"));
      } else {
        braces(head, node, indent);
      }
    } else if (kind == "conversion") {
      const std::string head = fmt::format("conversion {} -> {} = {}", node.text("from"),
                                           node.text("to"), node.text("function"));
      if (node.children.empty() && node.end_comments.empty()) {
        text_ += indent + head;
      } else {
        braces(head, node, indent);
      }
    } else if (kind == "relation") {
      const std::string head = fmt::format("relation {} in {} = {}", node.text("frame"),
                                           node.text("reference"), node.text("prototype"));
      if (node.has("constant")) {
        braces(head, node, indent);
      } else {
        text_ += indent + head;
      }
    } else if (kind == "fproto") {
      function(node, indent);
    }
  }

  static std::string form(const std::string& text) {
    std::string spaced;
    for (const char c : text) {
      spaced += c;
      if (c == ',') spaced += ' ';
    }
    return spaced;
  }

  void body(const Node& node, const std::string& indent, const std::string& head, bool blanks,
            auto&& print) {
    text_ += indent + head + " {\n";
    const std::string inner = indent + "  ";
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const Node& child = node.children[i];
      if (blanks && i > 0 && blank_before(child)) text_ += "\n";
      comments(child.comments, inner, blanks);
      print(child, inner);
      remark(child);
      text_ += "\n";
    }
    end_comments(node.end_comments, inner);
    text_ += indent + "}";
  }

  // "head a, b, c" with as many lines as it takes.
  void filled(const std::string& head, const std::vector<std::string>& parts,
              const std::string& separator, const std::string& indent) {
    std::string line = indent + head;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string part = " " + parts[i] + (i + 1 < parts.size() ? separator : "");
      if (line.size() + part.size() > kLineWidth) {
        text_ += line + "\n";
        line = indent + "   ";
      }
      line += part;
    }
    text_ += line;
  }

  void domain(const Node& node, const std::string& indent) {
    body(node, indent, fmt::format("domain {} ::", node.text("name")), true,
         [&](const Node& child, const std::string& inner) {
           if (child.kind == "coordinates") {
             std::string head = fmt::format("coordinates {} of {}", child.text("name"),
                                            fmt::join(child.all("of"), ", "));
             if (child.has("form")) head += " :: " + form(child.text("form"));
             braces(head, child, inner);
           } else if (child.kind == "formula") {
             std::string head = fmt::format("formula {} -> {} of {}", child.text("from"),
                                            child.text("to"), child.text("of"));
             if (child.has("loses")) head += fmt::format(" loses \"{}\"", child.text("loses"));
             raw(head, child.text("text"), inner);
           } else if (child.kind == "rule") {
             rule(child, inner);
           } else if (child.kind == "change") {
             change(child, inner);
           } else if (child.kind == "convention") {
             filled(fmt::format("convention {}{} of", child.text("name"),
                                child.has("optional") ? " ?" : ""),
                    child.all("of"), ",", inner);
           } else if (child.kind == "annotation" && child.has("value")) {
             filled(fmt::format("{}{} :", child.text("name"), child.has("optional") ? " ?" : ""),
                    child.all("value"), " |", inner);
           } else {
             text_ += inner + entry(child);
           }
         });
  }

  void rule(const Node& node, const std::string& indent) {
    text_ += fmt::format("{}relation {} of {}", indent, node.text("name"), node.text("of"));
    for (const char* part : {"identity", "inverse", "product"}) {
      text_ += "\n";
      raw(part, node.text(part), indent + "  ");
    }
  }

  void change(const Node& node, const std::string& indent) {
    filled(fmt::format("change {} {} of", node.text("convention"), node.text("name")),
           node.all("of"), ",", indent);
    if (node.has("needs")) {
      text_ += fmt::format("\n{}  needs \"{}\"", indent, node.text("needs"));
      return;
    }
    std::vector<std::string> inputs;
    for (const Node& input : node.children) {
      inputs.push_back(
          fmt::format("{} = {} in {}", input.text("name"), input.text("of"), input.text("in")));
    }
    text_ += "\n";
    raw(fmt::format("with {}", fmt::join(inputs, ", ")), node.text("text"), indent + "  ");
  }

  void prototype(const Node& unordered, const std::string& indent) {
    Node node = unordered;
    const auto order = [](const Node& field) {
      const auto rows = field_rows();
      return std::find_if(rows.begin(), rows.end(),
                          [&](const FieldRow& row) { return row.kind == field.kind; });
    };
    std::stable_sort(node.children.begin(), node.children.end(),
                     [&](const Node& a, const Node& b) { return order(a) < order(b); });
    body(node, indent, fmt::format("dproto {} :: {}", node.text("name"), node.text("domain")),
         false, [&](const Node& field, const std::string& inner) {
           const std::string head = fmt::format("{:<9} =", field.kind);
           if (field.has("value")) {
             text_ += fmt::format("{}{} {}", inner, head, field.text("value"));
           } else if (field.has("form")) {
             text_ += fmt::format("{}{} :: {}", inner, head, form(field.text("form")));
           } else if (field.has("context")) {
             raw(fmt::format("{} :: {}", head, field.text("context")), field.text("text"), inner);
           } else if (field.kind == "units") {
             braces(
                 fmt::format("{} :: {}, {}", head, field.text("ontology"), field.text("algebraic")),
                 field, inner);
           } else {
             braces(head, field, inner);
           }
         });
  }

  void function(const Node& node, const std::string& indent) {
    const std::string context = node.has("context") ? " :: " + node.text("context") : "";
    body(node, indent, fmt::format("fproto {}{}", node.text("name"), context), false,
         [&](const Node& field, const std::string& inner) {
           if (field.kind == "args") {
             braces("args =", field, inner);
           } else {
             text_ += inner + entry(field);
           }
         });
  }

  std::string text_;
  std::ptrdiff_t last_lines_ = 0;
};

}  // namespace

std::string format(const Node& file) { return Formatter().run(file); }

}  // namespace sinew::blocks
