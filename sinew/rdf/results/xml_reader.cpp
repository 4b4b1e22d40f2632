// Result sets from XML. Expat calls back for each tag and text; a small table says which element
// may stand in which.
#include <expat.h>
#include <fmt/format.h>

#include <climits>
#include <exception>
#include <memory>

#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/results/codecs.h"
#include "sinew/rdf/turtle/blank_scope.h"
#include "sinew/rdf/turtle/limits.h"

namespace sinew::rdf {
namespace {

using graph::Id;

// Expat puts this between a namespace and a name.
constexpr char kSeparator = '\n';
constexpr std::string_view kNamespace = "http://www.w3.org/2005/sparql-results#";
constexpr std::string_view kLanguage = "http://www.w3.org/XML/1998/namespace\nlang";

enum class Element {
  kDocument,  // what the root stands in
  kSparql,
  kHead,
  kVariable,
  kLink,
  kBoolean,
  kResults,
  kResult,
  kBinding,
  kUri,
  kBlank,
  kLiteral,
};

struct Rule {
  std::string_view name;
  Element element, parent;
  bool has_text;
};
constexpr Rule kRules[] = {
    {"sparql", Element::kSparql, Element::kDocument, false},
    {"head", Element::kHead, Element::kSparql, false},
    {"variable", Element::kVariable, Element::kHead, false},
    {"link", Element::kLink, Element::kHead, false},
    {"boolean", Element::kBoolean, Element::kSparql, true},
    {"results", Element::kResults, Element::kSparql, false},
    {"result", Element::kResult, Element::kResults, false},
    {"binding", Element::kBinding, Element::kResult, false},
    {"uri", Element::kUri, Element::kBinding, true},
    {"bnode", Element::kBlank, Element::kBinding, true},
    {"literal", Element::kLiteral, Element::kBinding, true},
};

class XmlReader {
 public:
  XmlReader(std::string_view file, graph::Terms& terms)
      : file_(file),
        terms_(terms),
        blanks_(terms),
        parser_(XML_ParserCreateNS("UTF-8", kSeparator), &XML_ParserFree) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), on_start, on_end);
    XML_SetCharacterDataHandler(parser_.get(), on_text);
    XML_SetStartDoctypeDeclHandler(parser_.get(), on_doctype);
  }

  ResultSet read(std::string_view text) {
    // Expat counts in int.
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t length = std::min<std::size_t>(text.size() - begin, INT_MAX / 2);
      const bool last = begin + length == text.size();
      const XML_Status status =
          XML_Parse(parser_.get(), text.data() + begin, static_cast<int>(length), last);
      if (fault_) std::rethrow_exception(fault_);
      if (status != XML_STATUS_OK) {
        fail_at(place(), XML_ErrorString(XML_GetErrorCode(parser_.get())),
                "give well-formed XML in UTF-8");
      }
      if (last) break;
      begin += length;
    }
    return builder_.finish(place(), has_results_);
  }

 private:
  static XmlReader& self(void* data) { return *static_cast<XmlReader*>(data); }

  // Exceptions must not pass through expat: they wait in fault_ until it has returned.
  template <typename Function>
  void guard(Function function) {
    if (fault_) return;
    try {
      function();
    } catch (...) {
      fault_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  static void on_start(void* data, const XML_Char* name, const XML_Char** attributes) {
    self(data).guard([&] { self(data).start(name, attributes); });
  }
  static void on_end(void* data, const XML_Char*) {
    self(data).guard([&] { self(data).end(); });
  }
  static void on_text(void* data, const XML_Char* text, int length) {
    self(data).guard([&] { self(data).add_text({text, static_cast<std::size_t>(length)}); });
  }
  // Results need no document type, and its entities could blow up a small text.
  static void on_doctype(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    XmlReader& reader = self(data);
    reader.guard([&] {
      fail_at(reader.place(), "there is a document type", "give results without <!DOCTYPE>");
    });
  }

  void start(std::string_view full_name, const XML_Char** attributes) {
    const std::size_t separator = full_name.find(kSeparator);
    const bool ours =
        separator != std::string_view::npos && full_name.substr(0, separator) == kNamespace;
    const std::string_view name =
        separator == std::string_view::npos ? full_name : full_name.substr(separator + 1);
    const Rule* rule = nullptr;
    for (const Rule& candidate : kRules) {
      if (ours && candidate.name == name && candidate.parent == current_.element) rule = &candidate;
    }
    if (rule == nullptr) {
      fail_at(
          place(), fmt::format("<{}> cannot stand here", name),
          fmt::format("write what SPARQL Query Results XML Format asks for, in the namespace {}",
                      kNamespace));
    }
    parents_.push_back(current_);
    current_ = {rule->element, rule->has_text};
    text_.clear();
    enter(rule->element, attributes);
  }

  void enter(Element element, const XML_Char** attributes) {
    switch (element) {
      case Element::kVariable:
        builder_.add_column(attribute(attributes, "name").value_or(""), place());
        break;
      case Element::kResults:
        if (has_results_) fail_at(place(), "there are two lists of results", "give one");
        has_results_ = true;
        break;
      case Element::kResult:
        builder_.add_row(place());
        break;
      case Element::kBinding:
        column_ = builder_.column(attribute(attributes, "name").value_or(""), place());
        term_ = {};
        break;
      case Element::kLiteral:
        datatype_ = attribute(attributes, "datatype").value_or("");
        language_ = attribute(attributes, kLanguage).value_or("");
        break;
      default:
        break;
    }
  }

  void end() {
    switch (current_.element) {
      case Element::kBoolean:
        if (text_ != "true" && text_ != "false") {
          fail_at(place(), fmt::format("\"{}\" is no boolean", text_), "write true or false");
        }
        if (has_results_) fail_at(place(), "there is a boolean besides results", "give one result");
        builder_.set_boolean(text_ == "true", place());
        break;
      case Element::kUri:
        if (const auto fault = fault_of_iri(text_)) {
          fail_at(place(), fmt::format("<{}>: {}", text_, *fault), "write an absolute IRI");
        }
        set_term(terms_.iri(text_));
        break;
      case Element::kBlank:
        set_term(blanks_.node(text_));
        break;
      case Element::kLiteral:
        set_term(literal());
        break;
      case Element::kBinding:
        if (!term_) fail_at(place(), "a binding has no value", "leave the binding out");
        builder_.bind(column_, term_, place());
        break;
      default:
        break;
    }
    current_ = parents_.back();
    parents_.pop_back();
    text_.clear();
  }

  Id literal() {
    if (!language_.empty()) {
      if (!is_language_tag(language_)) {
        fail_at(place(), fmt::format("\"{}\" is no language tag", language_),
                "write letters, then groups of letters and digits, each after a -");
      }
      return terms_.literal(text_, {}, language_);
    }
    if (datatype_.empty()) return terms_.literal(text_);
    if (const auto fault = fault_of_iri(datatype_)) {
      fail_at(place(), fmt::format("<{}>: {}", datatype_, *fault), "write an absolute IRI");
    }
    return terms_.literal(text_, datatype_);
  }

  void set_term(Id id) {
    if (term_) fail_at(place(), "a binding has two values", "give each variable one value a row");
    term_ = id;
  }

  void add_text(std::string_view text) {
    if (current_.has_text) {
      text_ += text;
      if (text_.size() > kMaxTermBytes) {
        fail_at(place(), fmt::format("a term is longer than {} bytes", kMaxTermBytes),
                "keep data of this size in a file of its own and refer to it");
      }
    } else if (text.find_first_not_of(" \t\r\n") != std::string_view::npos) {
      fail_at(place(), "there is text between the elements", "put it into a <literal>");
    }
  }

  static std::optional<std::string> attribute(const XML_Char** attributes, std::string_view name) {
    for (; *attributes != nullptr; attributes += 2) {
      if (name == attributes[0]) return attributes[1];
    }
    return std::nullopt;
  }

  Place place() const {
    return {file_, static_cast<std::size_t>(XML_GetCurrentLineNumber(parser_.get())),
            static_cast<std::size_t>(XML_GetCurrentColumnNumber(parser_.get())) + 1};
  }

  struct Open {
    Element element = Element::kDocument;
    bool has_text = false;
  };

  std::string file_;
  graph::Terms& terms_;
  BlankScope blanks_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::exception_ptr fault_;
  ResultBuilder builder_;
  bool has_results_ = false;
  Open current_;
  std::vector<Open> parents_;
  std::string text_;
  std::size_t column_ = 0;  // of the binding at hand
  Id term_;
  std::string datatype_, language_;
};

}  // namespace

ResultSet read_xml(std::string_view text, std::string_view file, graph::Terms& terms) {
  return XmlReader(file, terms).read(text);
}

}  // namespace sinew::rdf
