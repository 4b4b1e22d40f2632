#include "sinew/backend/render.h"

#include <algorithm>
#include <span>
#include <utility>

#include "sinew/base/error.h"

namespace sinew::backend {

std::span<const std::pair<std::string_view, std::string_view>> embedded_templates();

namespace {

constexpr std::size_t kNowhere = std::string_view::npos;

struct Tag {
  enum class Kind : std::uint8_t { kNone, kVariable, kSection, kInverted, kEnd, kComment };
  Kind kind = Kind::kNone;  // kNone: the text ends
  std::string_view name;
  std::size_t begin = 0, end = 0;  // in the template
};

constexpr int kDeepestSections = 64;

bool names_anywhere(const Fields& fields, std::string_view name) {
  if (fields.values.find(name) != fields.values.end()) return true;
  return std::any_of(fields.values.begin(), fields.values.end(), [&](const auto& field) {
    const auto* list = std::get_if<FieldList>(&field.second);
    return list != nullptr && std::any_of(list->begin(), list->end(), [&](const Fields& item) {
             return names_anywhere(item, name);
           });
  });
}

// Writes while it reads: templates are short, and each is filled once in a process.
class Renderer {
 public:
  Renderer(std::string_view path, std::string_view text) : path_(path), text_(text) {
    result_.reserve(text.size());
  }

  std::string run(const Fields& fields) {
    fields_.push_back(&fields);
    const Tag end = fill(0);
    if (end.kind != Tag::Kind::kNone)
      malformed(end.begin, "section " + name(end) + " ends but has not begun");
    end_line();
    return std::move(result_);
  }

 private:
  // `at`: where in the template.
  [[noreturn]] void refuse(std::size_t at, std::string what, std::string remedy) const {
    const std::string_view before = text_.substr(0, at);
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t end_of_last = before.rfind('\n');
    const std::size_t column = end_of_last == kNowhere ? at + 1 : at - end_of_last;
    throw Error(Problem{{std::string(path_), line, column},
                        {},
                        std::move(what),
                        std::move(remedy),
                        Severity::kError,
                        {}});
  }
  [[noreturn]] void malformed(std::size_t at, const std::string& what) const {
    refuse(at, "malformed template: " + what, "correct the template");
  }
  static std::string name(const Tag& tag) { return "'" + std::string(tag.name) + "'"; }

  // The first tag at or behind this place.
  Tag next_tag(std::size_t from) const {
    Tag tag;
    tag.begin = text_.find("{{", from);
    if (tag.begin == kNowhere) return tag;
    const std::size_t inside = tag.begin + 2;
    const char first = inside < text_.size() ? text_[inside] : '\0';
    const std::string_view close = first == '{' ? "}}}" : "}}";
    const std::size_t until = text_.find(close, inside);
    if (until == kNowhere) malformed(tag.begin, "a tag does not end");
    tag.end = until + close.size();
    tag.kind = first == '#'   ? Tag::Kind::kSection
               : first == '^' ? Tag::Kind::kInverted
               : first == '/' ? Tag::Kind::kEnd
               : first == '!' ? Tag::Kind::kComment
                              : Tag::Kind::kVariable;
    const bool marked = first == '{' || tag.kind != Tag::Kind::kVariable;
    tag.name = text_.substr(inside + (marked ? 1 : 0), until - inside - (marked ? 1 : 0));
    return tag;
  }

  // Fills in what stands from here to the end of the section; returns the tag that ends it.
  Tag fill(std::size_t from) {
    for (;;) {
      const Tag tag = next_tag(from);
      plain(text_.substr(from, tag.kind == Tag::Kind::kNone ? kNowhere : tag.begin - from));
      switch (tag.kind) {
        case Tag::Kind::kNone:
        case Tag::Kind::kEnd:
          return tag;
        case Tag::Kind::kComment:
          break;
        case Tag::Kind::kVariable:
          result_ += text_of(tag);
          break;
        case Tag::Kind::kSection:
        case Tag::Kind::kInverted:
          from = section(tag);
          continue;
      }
      from = tag.end;
    }
  }

  void plain(std::string_view text) {
    for (std::size_t end; (end = text.find('\n')) != kNowhere; text.remove_prefix(end + 1)) {
      result_ += text.substr(0, end);
      if (end_line()) result_ += '\n';
      line_ = result_.size();
    }
    result_ += text;
  }

  // A line of nothing but sections that were filled in is left out; returns whether it stays.
  bool end_line() {
    const bool stays = !has_section_ || result_.find_first_not_of(" \t", line_) != kNowhere;
    if (!stays) result_.resize(line_);
    has_section_ = false;
    return stays;
  }

  // Returns the place behind it.
  std::size_t section(const Tag& begin) {
    const auto* value = find(begin.name);
    if (value == nullptr && !names_anywhere(*fields_.front(), begin.name))
      refuse(begin.begin, "nothing names the section " + name(begin),
             "correct the name, or have what fills the template say whether it is there");
    const auto* flag = value == nullptr ? nullptr : std::get_if<bool>(value);
    const auto* list = value == nullptr ? nullptr : std::get_if<FieldList>(value);
    const bool none =
        value == nullptr || (flag != nullptr && !*flag) || (list != nullptr && list->empty());
    if (none != (begin.kind == Tag::Kind::kInverted)) return behind(begin);
    if (none || list == nullptr) return once(begin);
    std::size_t end = 0;
    for (const Fields& item : *list) {
      fields_.push_back(&item);
      end = once(begin);
      fields_.pop_back();
    }
    return end;
  }

  std::size_t once(const Tag& begin) {
    has_section_ = true;
    if (++depth_ > kDeepestSections)
      malformed(begin.begin, "sections stand in each other more than " +
                                 std::to_string(kDeepestSections) + " deep");
    const Tag end = fill(begin.end);
    --depth_;
    check_end(begin, end);
    has_section_ = true;  // of the line on which it ends
    return end.end;
  }

  void check_end(const Tag& begin, const Tag& end) const {
    if (end.kind == Tag::Kind::kNone || end.name != begin.name)
      malformed(begin.begin, "section " + name(begin) + " does not end");
  }

  // The place behind a section that is left out.
  std::size_t behind(const Tag& begin) const {
    std::vector<Tag> open = {begin};
    std::size_t from = begin.end;
    while (!open.empty()) {
      const Tag tag = next_tag(from);
      if (tag.kind == Tag::Kind::kSection || tag.kind == Tag::Kind::kInverted) {
        open.push_back(tag);
      } else if (tag.kind == Tag::Kind::kNone || tag.kind == Tag::Kind::kEnd) {
        check_end(open.back(), tag);
        open.pop_back();
      }
      from = tag.end;
    }
    return from;
  }

  // What a {{name}} stands for. A blank in its place would be code that nobody meant.
  const std::string& text_of(const Tag& tag) const {
    const Fields::Value* value = find(tag.name);
    if (value == nullptr)
      refuse(tag.begin, "nothing fills in " + name(tag),
             "correct the name, add it to what the template is given, or have it in a section that "
             "asks for it");
    const auto* text = std::get_if<std::string>(value);
    if (text == nullptr)
      refuse(tag.begin, name(tag) + " is a section, and has no text",
             "write {{#" + std::string(tag.name) + "}} to {{/" + std::string(tag.name) + "}}");
    return *text;
  }

  // The innermost of this name.
  const Fields::Value* find(std::string_view name) const {
    for (std::size_t k = fields_.size(); k-- > 0;) {
      const auto found = fields_[k]->values.find(name);
      if (found != fields_[k]->values.end()) return &found->second;
    }
    return nullptr;
  }

  std::string_view path_, text_;
  std::vector<const Fields*> fields_;  // the innermost is the last one
  std::string result_;
  std::size_t line_ = 0;      // where the current one begins in the result
  bool has_section_ = false;  // the current line
  int depth_ = 0;             // of the section that is filled in
};

}  // namespace

std::string_view template_text(std::string_view path) {
  for (const auto& [name, text] : embedded_templates()) {
    if (name == path) return text;
  }
  throw Error(Problem{{std::string(path), 0, 0},
                      {},
                      "no such template",
                      "templates are embedded when Sinew is built",
                      Severity::kError,
                      {}});
}

std::string fill_template(std::string_view path, std::string_view text, const Fields& fields) {
  return Renderer(path, text).run(fields);
}

std::string render(std::string_view path, const Fields& fields) {
  std::string result = fill_template("templates/" + std::string(path), template_text(path), fields);
  // The line of the comment that every template begins with.
  if (!result.empty() && result.front() == '\n') result.erase(0, 1);
  return result;
}

}  // namespace sinew::backend
