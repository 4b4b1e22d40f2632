// Result sets as text: SPARQL Query Results in XML and in JSON, and CSV and TSV (W3C
// Recommendations of 21 March 2013). For people there is table.h.
//
// Nothing is lost without a word: what a format cannot express (yes or no in CSV, control
// characters in XML) is an Error. CSV does not tell IRIs from literals; that is the format's own
// loss.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sinew/rdf/results/result_set.h"

namespace sinew::rdf {

enum class ResultFormat { kXml, kJson, kCsv, kTsv };

// By the end of the name: .srx .srj .csv .tsv; nothing for any other.
std::optional<ResultFormat> result_format_of_file(std::string_view name);

// Blank nodes are labelled b0, b1, ... in the order in which they appear.
std::string write_results(const ResultSet& results, ResultFormat format, const graph::Terms& terms);

// Faults throw Error with line and column; `file` is for the message. Blank nodes are new ones, the
// same for the same label within the text. From CSV, every value becomes a plain literal, except
// that an empty one is unbound and that "_:x" is a blank node.
ResultSet read_results(std::string_view text, ResultFormat format, std::string_view file,
                       graph::Terms& terms);

// Limits of the readers, with an Error beyond.
inline constexpr std::size_t kMaxResultColumns = 10'000;
inline constexpr std::size_t kMaxResultCells = 20'000'000;

}  // namespace sinew::rdf
