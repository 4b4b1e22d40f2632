#include "sinew/blocks/schema.h"

namespace sinew::blocks {
namespace {

using enum TextStyle;

constexpr TextRow kImport[] = {{"file", "file"}, {"as", "as"}};
constexpr TextRow kName[] = {{"name", "name"}};
constexpr TextRow kAnnotation[] = {
    {"name", "name"}, {"optional", "optional"}, {"value", "allowed", kList}};
constexpr TextRow kComposite[] = {{"name", "name"}, {"member", "members", kList}};
constexpr TextRow kCoordinates[] = {{"name", "name"}, {"of", "of", kList}, {"form", "form"}};
constexpr TextRow kParameter[] = {{"name", "name"}, {"unit", "unit"}, {"constant", "constant"}};
constexpr TextRow kFormula[] = {{"from", "from-coordinates"},
                                {"to", "to-coordinates"},
                                {"of", "meaning"},
                                {"loses", "loses"},
                                {"text", "text"}};
constexpr TextRow kConvention[] = {{"name", "name"}, {"optional", "optional"}, {"of", "of", kList}};
constexpr TextRow kRule[] = {{"name", "name"},
                             {"of", "meaning"},
                             {"identity", "identity"},
                             {"inverse", "inverse"},
                             {"product", "product"}};
constexpr TextRow kChange[] = {{"convention", "changes"},
                               {"name", "name"},
                               {"of", "of", kList},
                               {"needs", "needs"},
                               {"text", "text"}};
constexpr TextRow kGiven[] = {{"name", "name"}, {"of", "frame"}, {"in", "reference"}};
constexpr TextRow kRepresentation[] = {{"name", "name"}, {"context", "language"}, {"text", "text"}};
constexpr TextRow kAlgebraic[] = {{"name", "name"}, {"form", "form"}};
constexpr TextRow kUnits[] = {{"name", "name"},
                              {"ontology", "ontology"},
                              {"algebraic", "algebraic", kReference, "algebraic"}};
constexpr TextRow kUnit[] = {{"unit", "unit"}, {"accessor", "accessor"}};
constexpr TextRow kAlias[] = {{"left", "left-form", kReference, "algebraic"},
                              {"right", "right-form", kReference, "algebraic"}};
constexpr TextRow kEntry[] = {
    {"left", "left"}, {"sign", "sign"}, {"right", "right"}, {"constant", "constant"}};
constexpr TextRow kPrototype[] = {{"name", "name"}, {"domain", "domain", kReference, "domain"}};
constexpr TextRow kMember[] = {{"name", "name"}, {"value", "value"}};
constexpr TextRow kView[] = {{"prototype", "prototype", kReference, "dproto"},
                             {"member", "member"},
                             {"target", "target", kReference, "dproto"},
                             {"function", "function", kReference, "fproto"}};
constexpr TextRow kConversion[] = {{"from", "from", kReference, "dproto"},
                                   {"to", "to", kReference, "dproto"},
                                   {"function", "function", kReference, "fproto"}};
constexpr TextRow kRelation[] = {{"frame", "frame"},
                                 {"reference", "reference"},
                                 {"prototype", "prototype", kReference, "dproto"},
                                 {"constant", "constant"}};
constexpr TextRow kSetting[] = {
    {"name", "name"}, {"number", "number"}, {"word", "word"}, {"text", "text"}};
constexpr TextRow kFunction[] = {{"name", "name"}, {"context", "language"}};
constexpr TextRow kArgument[] = {
    {"position", "position"}, {"direction", "direction"}, {"prototype", "takes"}};

constexpr KindRow kKinds[] = {
    {"file", "File", {}},
    {"import", "Import", kImport},
    {"module", "Module", kName},
    {"domain", "Domain", kName, true},
    {"annotation", "Annotation", kAnnotation},
    {"composite", "Composite", kComposite},
    {"coordinates", "Coordinates", kCoordinates},
    {"parameter", "Parameter", kParameter},
    {"formula", "Formula", kFormula},
    {"convention", "Convention", kConvention},
    {"rule", "RelationRule", kRule},
    {"change", "Change", kChange},
    {"given", "GivenRelation", kGiven},
    {"older", "OlderName", kName},
    {"ddr", "Representation", kRepresentation, true},
    {"algebraic", "AlgebraicForm", kAlgebraic, true},
    {"units", "Units", kUnits, true},
    {"unit", "UnitEntry", kUnit},
    {"alias", "Alias", kAlias},
    {"entry", "MapEntry", kEntry},
    {"dproto", "Prototype", kPrototype, true},
    {"member", "Member", kMember},
    {"view", "View", kView},
    {"conversion", "Conversion", kConversion},
    {"relation", "Relation", kRelation},
    {"setting", "Setting", kSetting},
    {"fproto", "Function", kFunction, true},
    {"args", "Arguments", {}},
    {"argument", "Argument", kArgument},
};

constexpr FieldRow kFields[] = {
    {"semantic", "semantic", {}},
    {"coord", "coord", {}},
    {"convention", "convention", {}, kLiteral, {}, {}, "member"},
    {"algebraic", "algebraic", "form", kReference, "algebraic"},
    {"ddr", "representation", {}, kReference, "ddr", "ddr"},
    {"composes", "composes", {}, kLiteral, {}, {}, "member"},
    {"usingddr", "uses-representation", {}, kReference, "ddr", "ddr"},
    {"dr", "map", {}, kLiteral, {}, {}, "entry"},
    {"units", "units", {}, kReference, "units", "units"},
};

}  // namespace

std::span<const KindRow> kind_rows() { return kKinds; }
std::span<const FieldRow> field_rows() { return kFields; }

const KindRow* find_kind(std::string_view kind) {
  for (const KindRow& row : kKinds) {
    if (row.kind == kind) return &row;
  }
  return nullptr;
}

const KindRow* find_type(std::string_view type) {
  for (const KindRow& row : kKinds) {
    if (row.type == type) return &row;
  }
  return nullptr;
}

}  // namespace sinew::blocks
