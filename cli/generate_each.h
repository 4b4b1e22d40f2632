// Several functions of one robot in one go: what they have in common is computed once, the rest on
// all processors.
#pragma once

#include <string>
#include <vector>

#include "pipeline.h"
#include "sinew/backend/c_target.h"
#include "sinew/base/workers.h"

namespace sinew::cli {

// Code for each of these questions, in their order: byte for byte what each would get alone. The
// function of a question is named by its solver, after "`prefix`_" where there is a prefix;
// `options` hold for all of them but for the name and the source. What is thrown is what the first
// question that cannot be answered is refused with.
//
// The graph belongs to the calling thread: it synthesises for one question after the other, while
// others already lower, optimise and write those before it, the largest that is there first.
std::vector<backend::GeneratedCode> generate_each(
    Models& models, const ModelOptions& files, const std::vector<QueryOptions>& questions,
    const std::string& prefix, const backend::COptions& options,
    unsigned threads = Workers::as_many_as_the_machine_has());

// What such a function is called.
std::string function_name(const std::string& prefix, const QueryOptions& question);

}  // namespace sinew::cli
