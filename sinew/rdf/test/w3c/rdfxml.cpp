#include "rdfxml.h"

#include <expat.h>
#include <fmt/format.h>

#include <exception>
#include <memory>

#include "sinew/base/error.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/turtle/blank_scope.h"

namespace sinew::rdf::w3c {
namespace {

using graph::Id;

constexpr std::string_view kRdf = "http://www.w3.org/1999/02/22-rdf-syntax-ns#";

class Reader {
 public:
  Reader(const std::string& base, graph::Terms& terms)
      : base_(base),
        terms_(terms),
        blanks_(terms),
        // The namespace goes right before the name, which is just how RDF/XML makes IRIs of both.
        parser_(XML_ParserCreateNS("UTF-8", '\0'), &XML_ParserFree) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* data, const XML_Char* name, const XML_Char** attributes) {
          static_cast<Reader*>(data)->guard([&](Reader& self) { self.start(name, attributes); });
        },
        [](void* data, const XML_Char*) {
          static_cast<Reader*>(data)->guard([](Reader& self) { self.end(); });
        });
    XML_SetCharacterDataHandler(parser_.get(), [](void* data, const XML_Char* text, int length) {
      static_cast<Reader*>(data)->text_.append(text, static_cast<std::size_t>(length));
    });
  }

  std::vector<graph::Quad> read(std::string_view text) {
    const XML_Status status =
        XML_Parse(parser_.get(), text.data(), static_cast<int>(text.size()), XML_TRUE);
    if (fault_) std::rethrow_exception(fault_);
    if (status != XML_STATUS_OK) fail(XML_ErrorString(XML_GetErrorCode(parser_.get())));
    return std::move(quads_);
  }

 private:
  enum class Kind { kRoot, kNode, kProperty };
  struct Open {
    Kind kind;
    Id node;       // a node's own; a property's object, if it is known
    Id predicate;  // a property's
    std::string datatype, language;
  };

  template <typename Function>
  void guard(Function function) {
    if (fault_) return;
    try {
      function(*this);
    } catch (...) {  // must not pass through expat
      fault_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  void start(std::string_view name, const XML_Char** attributes) {
    if (open_.empty()) {
      if (name != std::string(kRdf) + "RDF") fail("the root is not rdf:RDF");
      open_.push_back({Kind::kRoot, {}, {}, {}, {}});
      return;
    }
    Open next{open_.back().kind == Kind::kNode ? Kind::kProperty : Kind::kNode, {}, {}, {}, {}};
    for (; *attributes != nullptr; attributes += 2) attribute(next, attributes[0], attributes[1]);
    if (next.kind == Kind::kProperty) {
      next.predicate = terms_.iri(name);
    } else {
      if (!next.node) next.node = terms_.fresh_blank();
      if (name != std::string(kRdf) + "Description") {
        add(next.node, terms_.iri(std::string(kRdf) + "type"), terms_.iri(name));
      }
      Open& parent = open_.back();
      if (parent.kind == Kind::kProperty) {
        if (parent.node) fail("a property has two objects");
        parent.node = next.node;
      }
    }
    open_.push_back(next);
    text_.clear();
  }

  void attribute(Open& open, std::string_view name, std::string_view value) {
    const bool node = open.kind == Kind::kNode;
    if (name == std::string(kRdf) + (node ? "about" : "resource")) {
      open.node = terms_.iri(resolve_iri(value, base_).value());
    } else if (name == std::string(kRdf) + "nodeID") {
      open.node = blanks_.node(value);
    } else if (!node && name == std::string(kRdf) + "datatype") {
      open.datatype = value;
    } else if (!node && name == "http://www.w3.org/XML/1998/namespacelang") {
      open.language = value;
    } else {
      fail(fmt::format("the attribute {} is not supported", name));
    }
  }

  void end() {
    const Open open = open_.back();
    open_.pop_back();
    if (open.kind == Kind::kProperty) {
      const Id object = open.node ? open.node : terms_.literal(text_, open.datatype, open.language);
      add(open_.back().node, open.predicate, object);
    } else if (text_.find_first_not_of(" \t\r\n") != std::string::npos) {
      fail("there is text between the elements");
    }
    text_.clear();
  }

  void add(Id subject, Id predicate, Id object) { quads_.push_back({subject, predicate, object}); }

  [[noreturn]] void fail(const std::string& what) {
    throw Error(Problem{{base_, XML_GetCurrentLineNumber(parser_.get()), 0},
                        "",
                        "RDF/XML: " + what,
                        "",
                        Severity::kError,
                        {}});
  }

  std::string base_;
  graph::Terms& terms_;
  BlankScope blanks_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::exception_ptr fault_;
  std::vector<graph::Quad> quads_;
  std::vector<Open> open_;
  std::string text_;
};

}  // namespace

std::vector<graph::Quad> read_rdf_xml(std::string_view text, const std::string& base,
                                      graph::Terms& terms) {
  return Reader(base, terms).read(text);
}

}  // namespace sinew::rdf::w3c
