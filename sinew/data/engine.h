// Conversions of live values while a program runs: the same straight-line code as emit.h writes, as
// a list of operations. On x86-64 the list becomes machine code when the Converter is made;
// elsewhere a small interpreter executes it, with the same result bit by bit. Making a Converter
// allocates, resolves library functions and may fail; running it does neither, takes no lock and
// always does the same number of operations.
//
//   const Converter converter = make_converter(library, plan);
//   converter.run(&source, &target);
//
// `source` and `target` are values of the plan's prototypes, laid out as their representations say;
// they may be the same memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sinew/data/program.h"

namespace sinew::data {

// The most numbers that a conversion may hold at once, and the bytes of intermediate values.
constexpr std::size_t kMaximumRegisters = 1024;
constexpr std::size_t kMaximumScratch = 16'384;
constexpr std::size_t kMaximumBlocks = 64;

struct EngineOptions {
  // Where libraries of functions are looked for before the usual places.
  std::vector<std::string> library_directories;
  // Keep to the interpreter where machine code would be possible.
  bool interpret = false;
};

class Converter {
 public:
  // False, with the target untouched, when a container that grows has too few elements on either
  // side. Any number of threads may run one converter at once.
  // `inputs` are the relations between frames that the conversion computes with, in the order of
  // inputs_of (plan.h); false where their number is another.
  bool run(const void* source, void* target, std::span<const void* const> inputs = {}) const;

  std::size_t operations() const { return operations_.size(); }
  // Whether the operations became machine code.
  bool compiled() const { return compiled_ != nullptr; }

 private:
  friend class ConverterBuilder;
  friend class ConverterCompiler;
  friend void compile(Converter& converter);
  using Compiled = bool (*)(double* registers, char* const* blocks, const Converter* converter);
  enum class Code : std::uint8_t;
  struct Operation {
    Code code = {};
    std::uint8_t kind = 0;              // of the number in memory
    std::uint16_t a = 0, b = 0, c = 0;  // registers, or the blocks of a load or store
    std::uint32_t x = 0, y = 0;         // bytes from the block's begin, or an index into a table
  };
  struct Place {  // of a double, and its register
    std::uint32_t offset = 0;
    std::uint32_t number = 0;
  };
  struct Path {  // of a number behind pointers
    std::vector<std::size_t> offsets;
  };
  struct Guard {
    std::size_t block = 0;
    bool list = false;  // asn1c's list, otherwise a std::vector
    std::vector<std::size_t> offsets;
    std::size_t element_size = 0, index = 0;
  };
  struct Call {
    enum class Form : std::uint8_t {
      kInOut,
      kOutIn,
      kValueOut,
      kOutValue,
      kReturnOfIn,
      kReturnOfValue
    };
    Form form = Form::kInOut;
    void* function = nullptr;
    std::size_t input = 0, output = 0;  // blocks
  };

  void call(const Call& call, char* const* blocks) const;
  bool step(const Operation& operation, double* registers, char* const* blocks) const;
  // The same for machine code to call.
  static bool step_at(const Converter* converter, std::uint64_t index, double* registers,
                      char* const* blocks);

  std::vector<Operation> operations_;
  std::vector<double> constants_;  // the first registers
  std::vector<Place> places_;
  std::vector<Path> paths_;
  std::vector<Guard> guards_;
  std::vector<Call> calls_;
  std::size_t inputs_ = 0;
  std::vector<std::size_t> scratch_;  // where each intermediate block begins
  std::vector<std::shared_ptr<void>> libraries_;
  std::shared_ptr<const void> code_;
  Compiled compiled_ = nullptr;
  bool needs_constants_ = true;  // among the registers
};

// Throws Error when a value has no fixed memory (JSON), a function's library or symbol is not
// found, or a limit is passed.
Converter make_converter(const Library& library, const Plan& plan,
                         const EngineOptions& options = {});

}  // namespace sinew::data
