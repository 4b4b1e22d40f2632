#include "generate_each.h"

#include <exception>
#include <future>

namespace sinew::cli {

std::string function_name(const std::string& prefix, const QueryOptions& question) {
  return prefix.empty() ? question.solver : prefix + "_" + question.solver;
}

std::vector<backend::GeneratedCode> generate_each(Models& models, const ModelOptions& files,
                                                  const std::vector<QueryOptions>& questions,
                                                  const std::string& prefix,
                                                  const backend::COptions& options,
                                                  unsigned threads) {
  Workers workers(threads);
  std::vector<std::future<backend::GeneratedCode>> pending;
  std::exception_ptr refused;  // the question behind the pending ones
  for (const QueryOptions& question : questions) {
    try {
      backend::COptions own = options;
      own.name = function_name(prefix, question);
      own.source = describe(files, question);
      own.one_thread = threads == 1;
      LaterProgram program = later_program_of(models, files, question, own.name);
      const std::size_t size = program.size();
      pending.push_back(workers.add(
          [program = std::move(program), own]() mutable {
            return backend::generate_c(std::move(program).take(), own);
          },
          size));
    } catch (const Error&) {
      refused = std::current_exception();
      break;
    }
  }
  workers.help();
  std::vector<backend::GeneratedCode> codes;
  for (auto& code : pending) codes.push_back(with_places(models, [&] { return code.get(); }));
  if (refused) std::rethrow_exception(refused);
  return codes;
}

}  // namespace sinew::cli
