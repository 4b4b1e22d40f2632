#include "sinew/rdf/results/formats.h"

#include "sinew/rdf/results/codecs.h"

namespace sinew::rdf {

std::optional<ResultFormat> result_format_of_file(std::string_view name) {
  if (name.ends_with(".srx")) return ResultFormat::kXml;
  if (name.ends_with(".srj")) return ResultFormat::kJson;
  if (name.ends_with(".csv")) return ResultFormat::kCsv;
  if (name.ends_with(".tsv")) return ResultFormat::kTsv;
  return std::nullopt;
}

std::string write_results(const ResultSet& results, ResultFormat format,
                          const graph::Terms& terms) {
  switch (format) {
    case ResultFormat::kXml:
      return write_xml(results, terms);
    case ResultFormat::kJson:
      return write_json(results, terms);
    case ResultFormat::kCsv:
      return write_csv(results, terms);
    default:
      return write_tsv(results, terms);
  }
}

ResultSet read_results(std::string_view text, ResultFormat format, std::string_view file,
                       graph::Terms& terms) {
  switch (format) {
    case ResultFormat::kXml:
      return read_xml(text, file, terms);
    case ResultFormat::kJson:
      return read_json(text, file, terms);
    case ResultFormat::kCsv:
      return read_csv(text, file, terms);
    default:
      return read_tsv(text, file, terms);
  }
}

}  // namespace sinew::rdf
